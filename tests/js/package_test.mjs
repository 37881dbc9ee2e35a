// SPDX-License-Identifier: BSD-3-Clause
// The tests of the npm package in Node:  REFERENCE=reference.json PACKAGE=build/js/delone node --test tests/js/package_test.mjs
import { readFileSync } from "node:fs";
import test from "node:test";
import { pathToFileURL } from "node:url";
import { casesOf } from "./cases.mjs";

const delone = await import(pathToFileURL(`${process.env.PACKAGE}/node.js`));
for (const [name, run] of casesOf(delone, JSON.parse(readFileSync(process.env.REFERENCE, "utf8")))) test(name, run);
