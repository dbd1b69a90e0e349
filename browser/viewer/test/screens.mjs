// Coarse pictures of a page: how bright, and how uneven, each square of its first screen is, and each column of all of it.
// Fonts and words hardly change them. What breaks a page does: text without contrast, a part that is missing or too wide.

const squares = 8;
/** Shown pixels for each of the page. At a quarter, letters are grey. */
const scale = 0.25;
const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/** Returns the coarse picture: a digit of 64 for each mean from 0 to 255, and each standard deviation from 0 to 127. */
export async function coarsePicture(page) {
  const { width, height } = await page.evaluate(() => {
    scrollTo(0, 0);
    const { scrollWidth, scrollHeight } = document.documentElement;
    return { width: scrollWidth, height: scrollHeight };
  });
  const session = await page.context().newCDPSession(page);
  const { data } = await session.send("Page.captureScreenshot",
    { captureBeyondViewport: true, clip: { x: 0, y: 0, width, height, scale } });
  const values = await page.evaluate(async ({ data, squares, share }) => {
    const image = Object.assign(new Image(), { src: `data:image/png;base64,${data}` });
    await image.decode();
    const context = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }).getContext("2d");
    context.drawImage(image, 0, 0);
    const values = [];
    const add = (height, rows) => {
      const sums = new Float64Array(3 * squares * rows);
      const { data } = context.getImageData(0, 0, image.width, height);
      for (let k = 0; k < image.width * height; ++k) {
        const column = Math.floor(((k % image.width) * squares) / image.width);
        const at = 3 * (Math.floor((Math.floor(k / image.width) * rows) / height) * squares + column);
        const grey = 0.3 * data[4 * k] + 0.59 * data[4 * k + 1] + 0.11 * data[4 * k + 2];
        sums[at] += grey;
        sums[at + 1] += grey * grey;
        sums[at + 2] += 1;
      }
      for (let at = 0; at < sums.length; at += 3) {
        const mean = sums[at] / sums[at + 2];
        values.push(mean / 4, Math.sqrt(Math.max(0, sums[at + 1] / sums[at + 2] - mean * mean)) / 2);
      }
    };
    add(Math.min(image.height, Math.round(share * image.height)), squares);
    add(image.height, 1);
    return values;
  }, { data, squares, share: Math.min(1, page.viewportSize().height / height) });
  return values.map((value) => digits[Math.min(63, Math.round(value))]).join("");
}

/** Returns the mean difference of two coarse pictures, in digits. */
export function difference(one, other) {
  let sum = 0;
  for (let k = 0; k < one.length; ++k) sum += Math.abs(digits.indexOf(one[k]) - digits.indexOf(other[k]));
  return sum / one.length;
}
