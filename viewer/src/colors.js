// SPDX-License-Identifier: BSD-3-Clause
// Color maps, as 33 colors that are interpolated linearly. viridis, magma and cividis are perceptually uniform; viridis and magma
// are by N. Smith, S. van der Walt and E. Firing, cividis by J. Nuñez, C. Anderton and R. Renslow, all released as CC0; coolwarm is
// by K. Moreland (doi:10.1007/978-3-642-10520-3_9).
const MAPS = {
  viridis: "440154470d6048186a482374472d7b4537814240863e49893b528b375b8d33638d2f6b8e2c728e297a8e26828e23898e21918c" +
    "1f988b1fa08822a78528ae8032b67a3fbc734ec36b5ec96270cf5784d44b98d83eaddc30c2df23d8e219ece51bfde725",
  magma: "0000040303120a0822130d341d114729115a36106b440f7651127c5d177f6a1c81762181832681902a819c2e7faa337db73779" +
    "c43c75d0416fdc4869e75263ef5d5ef56b5cf9795dfc8961fd9869fea772feb67cfec488fed395fde2a3fcf0b2fcfdbf",
  cividis: "00224e00285b002e6a0533711a386f273e6e32436d3b496c434e6c4b546c535a6d5a5f6e61656f686a716f70737676767d7c78" +
    "8482798c8878938e789b9476a39a74aba072b4a76fbcae6cc4b468cdbb63d5c25edec958e7d150f0d846f9e03afee838",
  coolwarm: "3b4cc0445acc4e68d85875e16282ea6c8ff1779af782a6fb8db0fe98b9ffa3c2feaec9fcb9d0f9c3d5f4ccd9edd5dbe5dddcdc" +
    "e5d8d1ecd3c5f1ccb8f5c4acf7ba9ff7b093f6a586f4987af08b6eeb7d62e46e56dd5f4bd44e41ca3b37be242eb40426",
};

export const MAP_NAMES = Object.keys(MAPS);

/** 256 colors of four bytes each. */
export function colorsOf(name) {
  const text = MAPS[name], last = text.length / 6 - 1, result = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const position = i / 255 * last, left = Math.min(Math.floor(position), last - 1), part = position - left;
    for (let c = 0; c < 3; ++c) {
      const at = 6 * left + 2 * c;
      const a = parseInt(text.slice(at, at + 2), 16), b = parseInt(text.slice(at + 6, at + 8), 16);
      result[4 * i + c] = Math.round(a + (b - a) * part);
    }
    result[4 * i + 3] = 255;
  }
  return result;
}

/** The map as a gradient of CSS, from left to right. */
export function gradientOf(name) {
  return `linear-gradient(to right, ${MAPS[name].match(/.{6}/g).map((color) => "#" + color).join(", ")})`;
}
