// node view.mjs PAGE LARGE MANY NINE: fails where a page of `skelgen view` does not show on the screen what it is to show. PAGE
// holds a body, one in the A-pose (both with the clip walk), something that is no body and something that cannot be read; LARGE a body of 100
// thousand faces; MANY two dozen bodies; NINE a body of nine primitives with materials.
import { readFile, writeFile } from "node:fs/promises";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { changed, Faults, launch, picture, pixel } from "./browser.mjs";

const [path, large_path, many_path, nine_path] = process.argv.slice(2);
const faults = new Faults();
const expect = faults.expect.bind(faults);
const browser = await launch();

/// A page, when it is ready; nothing moves by itself unless that is wanted. Whatever it complains about or asks a network
/// for is a fault.
async function open(file, options) {
  const context = await browser.newContext({ reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  page.on("console", (message) => expect(message.type() !== "error", `the page says: ${message.text()}`));
  page.on("pageerror", (error) => expect(false, `the page fails: ${error}`));
  page.on("request", (request) => expect(/^(file|data|blob):/.test(request.url()), `it asks for ${request.url()}`));
  await page.goto(pathToFileURL(resolve(file)).href, { timeout: 120000 }); // others may use the machine
  await page.waitForSelector('body[data-state="ready"]', { timeout: 60000 });
  await settled(page);
  return page;
}

const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const shot = async (page) => (await settled(page), picture(page.locator("#canvas")));

/// Where the joint of that name is on the screen, of the given body; or where it was when names were shown last.
async function place(page, name, body = 0) {
  return page.evaluate(([name, body]) => {
    const found = [...document.querySelectorAll(".joint")].filter((label) => label.textContent === name)[body];
    const stage = document.getElementById("stage").getBoundingClientRect();
    return { x: Number(found.dataset.x) + stage.left, y: Number(found.dataset.y) + stage.top };
  }, [name, body]);
}

async function press(page, ...keys) {
  for (const key of keys) await page.keyboard.press(key);
  await settled(page);
}

async function slide(page, id, value) {
  await page.locator(`#${id}`).evaluate((slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, String(value));
  await settled(page);
}

const distance = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);

// ---- what is shown ----

const page = await open(path, { viewport: { width: 1100, height: 700 } });
const first = await shot(page);
const covered = changed(first, { ...first, data: Buffer.alloc(first.data.length, first.data.subarray(0, 4)) });
expect(covered > 0.03 && covered < 0.7, `the bodies cover ${covered} of the picture`);

for (const [key, layer, least] of [["b", "Body", 0.02], ["s", "Skeleton", 0.002], ["g", "Floor", 0.005], ["c", "Curve", 0.0005],
  ["x", "Sections", 0.002], ["f", "Directions", 0.0005]]) {
  await press(page, key);
  const toggled = changed(first, await shot(page));
  expect(toggled > least, `key ${key}: ${layer} changes ${toggled} of the picture`);
  await page.getByRole("button", { name: layer, exact: true }).click();
  expect(changed(first, await shot(page)) === 0, `${layer}: a second time does not bring back the picture`);
}

const captions = await page.locator(".body").allInnerTexts();
expect(captions.length === 4, `${captions.length} bodies have a caption`);
expect(captions.filter((caption) => caption.includes("no skeleton")).length === 1, "what is no body does not say so");
expect(captions.filter((caption) => caption.includes("\n")).length === 2, "the refused ones do not say why");
const columns = await page.locator(".body").evaluateAll((all) => all.map((one) => one.getBoundingClientRect().x));
expect(columns.every((x, i) => i === 0 || x > columns[i - 1]), `bodies are not side by side: ${columns}`);

// ---- joints: names, confidence, sides ----

expect((await page.locator(".joint:visible").count()) === 0, "names are there before they are asked for");
await press(page, "n");
const boxes = (where, selector) => where.locator(selector).evaluateAll((all) => all.map((one) => {
  const { left, right, top, bottom } = one.getBoundingClientRect();
  return { left, right, top, bottom };
}));
const overlaps = (texts) => texts.flatMap((a, i) => texts.slice(0, i).filter((b) =>
  a.left < b.right - 2 && b.left < a.right - 2 && a.top < b.bottom - 2 && b.top < a.bottom - 2)).length;
const named = await boxes(page, ".joint:visible");
expect(named.length >= 30, `of 42 joints of two bodies ${named.length} have a name`);
expect(overlaps(named) === 0, `${overlaps(named)} pairs of joints' names lie on each other`);
for (const name of ["left_elbow", "right_knee", "head"]) {
  const at = await place(page, name);
  await page.mouse.move(at.x, at.y);
  const tip = await page.locator("#tip").innerText();
  expect(new RegExp(`^${name}: confidence [01]\\.\\d\\d$`).test(tip), `at ${name} the tip is "${tip}"`);
}
await page.mouse.move(3, 3);
expect(!(await page.locator("#tip").isVisible()), "far from joints there is a tip");

await press(page, "2", "s", "n"); // nothing on the surface
await slide(page, "opacity", 1);
const by_sides = await shot(page);
for (const [name, is_blue] of [["left_elbow", true], ["right_elbow", false], ["left_knee", true], ["right_knee", false]]) {
  const at = await place(page, name, 1);
  const [red, , blue] = pixel(by_sides, at.x, at.y);
  expect(is_blue ? blue > red + 20 : red > blue + 20, `${name} has the colour of the other side`);
}
await press(page, "3");
await page.locator("#joint").selectOption("left_knee");
const by_weight = await shot(page);
const light_of_calf = async (side) => { // in its middle: at the knee itself the weights change from thigh to calf
  const knee = await place(page, `${side}_knee`, 1), ankle = await place(page, `${side}_ankle`, 1);
  const [red, green] = pixel(by_weight, (knee.x + ankle.x) / 2, (knee.y + ankle.y) / 2);
  return red + green;
};
expect((await light_of_calf("left")) > (await light_of_calf("right")) + 60, "the knee's weights do not show at the calf");

// ---- bent by sliders ----

await press(page, "1", "s", "n");
const names = ["left_shoulder", "left_elbow", "left_wrist", "left_hand", "right_wrist", "left_knee"];
const places = async () => Object.fromEntries(await Promise.all(names.map(async (name) => [name, await place(page, name)])));
const at_rest = await places(), rest = await shot(page);
for (const axis of ["bend", "swing"]) {
  await page.locator("#joint").selectOption("left_elbow");
  await slide(page, axis, 80);
  const bent = await places();
  expect(distance(bent.left_wrist, at_rest.left_wrist) > 15, `${axis} moves the wrist by ${distance(bent.left_wrist, at_rest.left_wrist)} pixels`);
  for (const still of ["left_shoulder", "left_elbow", "right_wrist", "left_knee"])
    expect(distance(bent[still], at_rest[still]) < 0.6, `${axis} of the elbow moves ${still}`);
  expect(changed(rest, await shot(page)) > 0.001, `${axis} does not change the picture`);
  await page.getByRole("button", { name: "Rest pose" }).click();
  await settled(page);
  expect(distance((await places()).left_wrist, at_rest.left_wrist) < 0.6, "the pose at rest does not come back");
}
await page.close();

// ---- digits ----

const handy = await open(path, { viewport: { width: 1100, height: 700 } });
await handy.locator("#bodies-list .name").first().click();
await handy.locator("#canvas").focus();
await press(handy, "n");
const tips = ["left_wrist", "left_index_1", "left_index_3", "left_little_3", "right_index_3"];
const ends = async () => Object.fromEntries(await Promise.all(tips.map(async (name) => [name, await place(handy, name)])));
const flat = await ends();
const only = async (moved, how) => {
  const now = await ends();
  for (const name of tips) {
    const way = distance(now[name], flat[name]);
    expect(moved.includes(name) ? way > 2 : way < 0.6, `${how} moves ${name} by ${way} pixels`);
  }
};
await handy.mouse.move(flat.left_index_3.x, flat.left_index_3.y);
expect((await handy.locator("#tip").innerText()).startsWith("left_index_3: confidence "), "a finger under the pointer has no tip");
await handy.locator("#joint").selectOption("left_index_2");
await slide(handy, "bend", 80);
await only(["left_index_3"], "to bend a finger");
await handy.getByRole("button", { name: "Rest pose" }).click();
await slide(handy, "curl", 80);
await only(["left_index_3", "left_little_3"], "to curl a hand");
expect((await handy.locator('output[for="curl"]').innerText()) === "80\u00b0", "the curl is not said");
await press(handy, "e");
expect(await handy.locator("#mirror").isDisabled(), "digits can be mirrored");
await handy.locator("#joint").selectOption("left_elbow");
expect(!(await handy.locator("#curl").isVisible()), "an elbow can be curled");
await handy.close();

// ---- a clip ----

const moving = await open(path, { viewport: { width: 1100, height: 700 }, reducedMotion: "no-preference" });
expect((await moving.locator("#play").innerText()) === "Pause", "a page with a clip does not open playing");
await press(moving, "n");
expect((await moving.locator("#clip option").allInnerTexts()).join() === "walk", "the clip is not offered");
const moves = [["left_wrist", 0], ["right_wrist", 0], ["left_wrist", 1], ["right_wrist", 1]]; // a foot may stand
const in_clip = () => Promise.all(moves.map(([name, body]) => place(moving, name, body)));
const apart = (a, b) => Math.min(...a.map((one, i) => distance(one, b[i])));
await slide(moving, "time", 0.3);
const early = await in_clip();
await slide(moving, "time", 0.6);
const late = await in_clip();
expect((await moving.locator("#play").innerText()) === "Play", "a clip goes on playing when it is put to a time");
expect(apart(early, late) > 1, `between two times of the clip a wrist moves by ${apart(early, late)} pixels`);
await moving.locator("#canvas").focus();
await press(moving, " ");
expect((await moving.locator("#play").innerText()) === "Pause", "a clip that is played cannot be paused");
await moving.waitForTimeout(400);
expect(apart(late, await in_clip()) > 0, "a clip that is played stands still");
await moving.getByRole("button", { name: "Rest pose" }).click();
expect((await moving.locator("#play").innerText()) === "Play", "the pose at rest does not end the clip");
await moving.close();

// ---- bodies in the list ----

const listed = await open(path, { viewport: { width: 1100, height: 700 } });
await press(listed, "n");
const of_all = distance(await place(listed, "head", 1), await place(listed, "left_foot", 1));
const names_of_list = listed.locator("#bodies-list .name");
await names_of_list.nth(1).click();
await settled(listed);
expect((await listed.locator(".joint:visible").count()) >= 38, "near by names are left out");
const alone = distance(await place(listed, "head", 1), await place(listed, "left_foot", 1));
expect(alone > 1.5 * of_all, `in focus a body is ${alone} pixels high, before ${of_all}`);
expect((await names_of_list.nth(1).getAttribute("aria-current")) === "true", "the list does not say which body is in focus");
await press(listed, "0");
const with_both = await shot(listed);
await listed.locator("#bodies-list .eye").first().click();
expect(changed(with_both, await shot(listed)) > 0.01, "a body that is hidden is seen");
const of_other = await listed.locator(".joint:visible").allInnerTexts();
expect(new Set(of_other).size === of_other.length, "a body that is hidden has names");
await listed.locator("#bodies-list .eye").first().click();
expect(changed(with_both, await shot(listed)) < 0.001, // but for the edges of letters
  "a body that is shown again is not as before");
await listed.close();

// ---- a character of nine primitives ----

const nine = await open(nine_path, { viewport: { width: 1000, height: 700 } });
expect((await nine.getByRole("button", { name: "Materials" }).getAttribute("aria-pressed")) === "true", "it does not open in its materials");
expect(/drag.*wheel.*click/i.test(await nine.locator("#hint").innerText()), "nothing says what mouse and wheel do");
for (const [key, opacity] of [["4", 1], ["4", 0.5], ["1", 1], ["2", 1], ["3", 0.4]]) {
  await press(nine, key);
  await slide(nine, "opacity", opacity);
  const with_bones = await shot(nine);
  await press(nine, "s");
  const bones = changed(with_bones, await shot(nine));
  expect(bones > 0.004, `in colours ${key} at opacity ${opacity} the skeleton is ${bones} of the picture`);
  await slide(nine, "opacity", opacity - 0.3);
  const fainter = changed(with_bones, await shot(nine), 3);
  expect(fainter > 0.03, `in colours ${key} another opacity changes ${fainter} of the picture`);
  await press(nine, "s");
}

// ---- joints put right ----

await press(nine, "1", "n", "e");
await slide(nine, "opacity", 0.6);
const found = await places_of(nine), surface = await surface_of(nine);
await nine.mouse.move(found.left_elbow.x, found.left_elbow.y);
await nine.mouse.down();
await nine.mouse.move(found.left_elbow.x + 20, found.left_elbow.y - 10, { steps: 4 });
await nine.mouse.move(found.left_elbow.x + 40, found.left_elbow.y - 20, { steps: 4 });
await nine.mouse.up();
await nine.mouse.move(3, 3);
const dragged = await places_of(nine);
expect(distance(dragged.left_elbow, { x: found.left_elbow.x + 40, y: found.left_elbow.y - 20 }) < 1.5, "a joint does not go where it is dragged");
for (const name of Object.keys(found).filter((name) => name !== "left_elbow"))
  expect(distance(dragged[name], found[name]) < 0.6, `to drag the elbow moves ${name}`);
expect(changed(surface, await surface_of(nine), 40) < 0.0005, "to drag a joint moves the surface");
await press(nine, "k");
const mirrored = await places_of(nine);
expect(distance(mirrored.right_elbow, found.right_elbow) > 10, "the other side does not take the joint");
expect(distance(mirrored.left_elbow, dragged.left_elbow) < 0.6, "to mirror a joint moves itself");
await press(nine, "Control+z");
expect(distance((await places_of(nine)).right_elbow, found.right_elbow) < 0.6, "what was mirrored cannot be undone");
await press(nine, "ArrowRight", "Shift+ArrowUp");
const nudged = await places_of(nine);
expect(nudged.left_elbow.x > dragged.left_elbow.x + 1 && nudged.left_elbow.y < dragged.left_elbow.y - 8, "arrows do not move the joint");
await press(nine, "Control+z", "Control+z", "Control+z");
expect(distance((await places_of(nine)).left_elbow, found.left_elbow) < 0.6, "a joint that was dragged does not come back");
expect(await nine.locator("#undo").isDisabled(), "where all is undone more can be");
await press(nine, "Control+Shift+z");
expect(distance((await places_of(nine)).left_elbow, dragged.left_elbow) < 0.6, "what was undone cannot be done again");
const download = nine.waitForEvent("download");
await nine.getByRole("button", { name: "Save skeleton" }).click();
await (await download).saveAs("dragged.json"); // which the program takes
const saved = JSON.parse(await readFile("dragged.json", "utf8"));
const before = await nine.evaluate(() => JSON.parse(document.getElementById("bodies").textContent)[0].skeleton);
const moved = saved.joints.filter((joint, j) => joint.position.some((x, i) => x !== before.joints[j].position[i]));
expect((await download).suggestedFilename() === "nine.json", `the skeleton is saved as ${(await download).suggestedFilename()}`);
expect(moved.map(({ name }) => name).join() === "left_elbow", `the file has other places of ${moved.map(({ name }) => name)}`);
const elbow = before.joints.findIndex(({ name }) => name === "left_elbow");
const way = Math.hypot(...saved.joints[elbow].position.map((x, i) => x - before.joints[elbow].position[i]));
const per_pixel = Math.hypot(...before.joints.find(({ name }) => name === "head").position.map((x, i) => x - before.joints[0].position[i])) /
  distance(found.head, found.crotch);
expect(Math.abs(way / (per_pixel * Math.hypot(40, 20)) - 1) < 0.25, `in the file it moved by ${way}, on the screen by ${per_pixel * Math.hypot(40, 20)}`);
await nine.close();

async function places_of(page) {
  return Object.fromEntries(await Promise.all(["head", "crotch", "left_shoulder", "left_elbow", "left_wrist", "right_elbow", "left_knee"]
    .map(async (name) => [name, await place(page, name)])));
}

/// The picture without bones and names.
async function surface_of(page) {
  await page.locator("#canvas").focus();
  await press(page, "s", "n");
  const picture = await shot(page);
  await press(page, "s", "n");
  return picture;
}

// ---- small screens ----

const narrow = await open(path, { viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true });
for (const unfolded of [false, true]) {
  if (unfolded) await narrow.locator("#fold").tap();
  const wide = await narrow.evaluate(() => Math.max(document.documentElement.scrollWidth, document.getElementById("panel").scrollWidth));
  expect(wide <= 360, `at 360 pixels the page is ${wide} wide`);
  const [hint, play, canvas] = await Promise.all(["#hint", "#motion", "#canvas"].map((one) => narrow.locator(one).boundingBox()));
  expect(hint.x >= 0 && hint.x + hint.width <= 330 && play.x >= 0 && play.x + play.width <= 360, "at 360 pixels something is cut off");
  expect(play.y + play.height <= canvas.y + canvas.height, "at 360 pixels the controls of the clip lie under others");
}
await narrow.locator("#edit").scrollIntoViewIfNeeded();
await narrow.locator("#edit").tap();
expect(await narrow.locator("#save").isVisible(), "at 360 pixels joints cannot be put right");
await narrow.close();

const phone = await open(path, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 3 });
expect(!(await phone.locator("#panel").isVisible()), "on a phone the controls hide the bodies");
await phone.locator("#fold").tap();
const panel = await phone.locator("#panel").boundingBox(), canvas = await phone.locator("#canvas").boundingBox();
expect(panel && canvas.y + canvas.height <= panel.y + 13, // whose upper corners are round
   "on a phone the controls lie on the bodies");
expect(panel && panel.width <= 390 && canvas.width <= 390, "on a phone the page is wider than the screen");
await phone.getByRole("button", { name: "Names", exact: true }).tap();
await settled(phone);
const touched = await place(phone, "left_elbow");
await phone.touchscreen.tap(touched.x, touched.y);
expect((await phone.locator("#tip").innerText()).includes("confidence"), "a tap on a joint tells nothing");
await phone.close();

// ---- one that the browser cannot show ----

const torn_path = `${path}.torn.html`; // as the page, but for the first body's file
await writeFile(torn_path, (await readFile(path, "utf8")).replace(/"glb":"[^"]{40}/, '"glb":"'));
const torn = await open(torn_path, { viewport: { width: 1100, height: 700 } });
const told = await torn.locator(".body").allInnerTexts();
expect(told.length === 4 && told[0].includes("cannot be shown"), `where one cannot be shown the page has ${told}`);
await press(torn, "n");
expect((await torn.locator(".joint:visible").count()) >= 15, "with the one that cannot be shown, others are not");
await torn.close();

// ---- many ----

for (const viewport of [{ width: 1400, height: 800 }, { width: 390, height: 844 }]) {
  const many = await open(many_path, { viewport });
  const texts = await boxes(many, ".body");
  expect(texts.length === 24 && overlaps(texts) === 0, `${overlaps(texts)} pairs of ${texts.length} names lie on each other`);
  await press(many, "n");
  const head = await place(many, "head"), foot = await place(many, "left_foot");
  const least = Math.min(viewport.width / 12, viewport.height / 6);
  expect(distance(head, foot) > least, `of many bodies one has ${distance(head, foot)} pixels from head to foot`);
  await many.close();
}

// ---- large ----

const large = await open(large_path, { viewport: { width: 1100, height: 700 } });
await large.locator("#canvas").focus();
// What the page itself does for a frame; what a graphics card does beside it is not measured where there is none.
const milliseconds = await large.evaluate(() => new Promise((done) => {
  const times = [], original = window.requestAnimationFrame;
  window.requestAnimationFrame = (callback) => original((now) => {
    const start = performance.now();
    callback(now);
    times.push(performance.now() - start);
  });
  let left = 40;
  const canvas = document.getElementById("canvas"), slider = document.getElementById("bend");
  const turn = () => {
    if (left-- <= 0 && (times.length >= 8 || left < -1000)) // others may use the machine
      return done(times.sort((a, b) => a - b)[Math.floor(times.length / 4)] ?? Infinity);
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
    slider.value = String(left);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    setTimeout(turn, 60);
  };
  turn();
}));
expect(milliseconds < 1000 / 60, `a frame of a large body takes the page ${milliseconds} ms`);
console.log(`a frame of 100 thousand faces takes the page ${milliseconds.toFixed(1)} ms beside the drawing`);
await browser.close();
faults.finish("skelgen view");
