/* Checks a page of pairs. It runs after the page's own script, opens each pair in each mode, and checks the drawn pictures. */
(async () => {
	const problems = [];
	const check = (holds, text) => holds || problems.push(text);
	const soon = ms => new Promise(done => setTimeout(done, ms));
	/* Spends real time, because the page's virtual clock runs ahead of the threads that unpack pictures. */
	const spin = () => {
		let x = 1;
		for (let i = 0; i < 2e6; i++) x = (x * 48271) % 2147483647;
		return x;
	};
	const until = async holds => {
		for (let i = 0; i < 200 && !holds(); i++) {
			spin();
			await soon(10);
		}
	};
	const modes = { s: "slide", f: "flip", " ": "flip", d: "side", e: "error", w: "error", z: "error" };
	const reader = create("canvas").getContext("2d", { willReadFrequently: true });
	const press = key => document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
	addEventListener("error", e => problems.push(e.message));
	addEventListener("unhandledrejection", e => problems.push(String(e.reason)));
	const cards = $$(".pairing");
	const statuses = cards.map(card => card.dataset.status).join(" ");
	check(statuses === "differs differs differs missing new equal", statuses);
	let drawn = 0;
	for (const card of $$(".pairing:has(.opens)")) {
		$(".opens", card).click();
		check(card.classList.contains("on"), `${card.id} is not open`);
		const seenIn = {};
		for (const key of ["s", "f", " ", "d", "e", "w", "z"]) {
			press(key);
			const root = $(".viewer", card);
			await until(() => root.dataset.shown?.endsWith("|" + modes[key]));
			await soon(100);
			let sum = 0;
			const read = () => {
				Object.assign(reader.canvas, { width: 200, height: 150 });
				reader.drawImage($(".stage canvas", card), 0, 0, 200, 150);
				const { data } = reader.getImageData(0, 0, 200, 150);
				sum = 0;
				for (let i = 0; i < data.length; i += 4) sum += data[i] + 3 * data[i + 1] + 7 * data[i + 2];
				return sum;
			};
			const other = { " ": "f", e: "d" }[key];
			await until(() => read() > 0 && sum !== seenIn[other]);
			check(sum > 0, `${card.id} ${key}: nothing is drawn`);
			seenIn[key] = sum;
			drawn++;
		}
		check(!card.textContent.includes("undefined"), `${card.id}: a text is undefined`);
		check(seenIn.f !== seenIn[" "], `${card.id}: both sides look alike`);
		check(seenIn.e !== seenIn.d, `${card.id}: the map equals a picture`);
		press("Escape");
		check(!$(".viewer", card), `${card.id} is not closed`);
	}
	check(drawn === 21, `${drawn} views`);
	for (const [key, shown] of [["failed", 5], ["passed", 1], ["all", 6]]) {
		$(`#filter [data-key=${key}]`).click();
		const visible = cards.filter(card => card.offsetWidth).length;
		check(visible === shown, `${key}: ${visible} of ${shown} are shown`);
	}
	check(ROOT.scrollWidth <= innerWidth, `the page is ${ROOT.scrollWidth - innerWidth} px too wide`);
	const before = getComputedStyle(document.body).backgroundColor;
	$("#theme").click();
	check(getComputedStyle(document.body).backgroundColor !== before, "the theme stays");
	const found = create("pre");
	found.id = "found";
	found.textContent = problems.length ? "FAILED: " + problems.join("; ") : `PASSED: ${drawn} views`;
	document.body.append(found);
})();
