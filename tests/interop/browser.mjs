// What the tests in a browser share: the browser, and pictures as numbers.
import { PNG } from "pngjs";
import { chromium } from "playwright-core";

/// Headless Chromium that draws by itself, without a graphics card.
export function launch() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
}

/// The picture of a page or an element of it.
export async function picture(shown) {
  return PNG.sync.read(await shown.screenshot({ animations: "disabled" }));
}

/// Red, green and blue at a place.
export function pixel(image, x, y) {
  return [...image.data.subarray(4 * (Math.round(y) * image.width + Math.round(x))).subarray(0, 3)];
}

/// How much of the picture differs by more than `least` levels in a channel.
export function changed(a, b, least = 12) {
  let count = 0;
  for (let i = 0; i < a.data.length; i += 4)
    if ([0, 1, 2].some((c) => Math.abs(a.data[i + c] - b.data[i + c]) > least)) ++count;
  return count / (a.data.length / 4);
}

/// Collects what is not as it should be.
export class Faults {
  found = [];
  expect(condition, what) {
    if (!condition) this.found.push(what);
  }
  /// Prints all and the sum, and ends the process.
  finish(what) {
    for (const fault of this.found) console.log(fault);
    console.log(`${what}: ${this.found.length} faults`);
    process.exit(this.found.length === 0 ? 0 : 1);
  }
}
