// SPDX-License-Identifier: BSD-3-Clause
// A class for each kind of failure, as in Python.

export class DeloneError extends Error {
  constructor(message, status = "internal_error", rows = []) {
    super(message);
    this.status = status;
    this.rows = rows;
  }
  get name() {
    return this.constructor.name;
  }
}
export class InputError extends DeloneError {
  constructor(message, status = "invalid_argument", rows = []) {
    super(message, status, rows);
  }
}
export class OutOfMemoryError extends DeloneError {}
export class TimeLimitError extends DeloneError {}
export class CancelledError extends DeloneError {}

const others = { out_of_memory: OutOfMemoryError, time_limit: TimeLimitError, cancelled: CancelledError, internal_error: DeloneError };

/** The error of a status of the C interface. */
export function errorOf(status, message, rows) {
  return new (others[status] ?? InputError)(message, status, rows);
}
