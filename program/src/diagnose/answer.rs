//! The answer in words, for a terminal or a page: the mistakes, their evidence, what to do, and
//! which mistakes this scene cannot show.

use super::{
    Amount, Cause, Diagnosis, FittedLight, Fog, MISTAKES, Mistake, Numbers, Order, Rows, Spot,
    Verdict, Window, scene_that_tells, scenes_that_show,
};
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use core::fmt::Write;
use fastphong::number::counted::{counted, grouped};

/// A line of an answer, which may be longer than a line of a terminal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// Running text.
    Text(String),
    /// One of a list.
    Item(String),
    /// A text with a heading beside it.
    Row {
        /// The heading, empty if the row goes on with the one before.
        head: String,
        /// The text.
        text: String,
    },
    /// The end of a paragraph.
    Gap,
}

/// The names that an answer uses.
pub struct Asked<'a> {
    /// The picture.
    pub picture: &'a str,
    /// The scene.
    pub scene: &'a str,
    /// The method that should have drawn the picture.
    pub method: Option<String>,
    /// The scene's own size, and the size at which it was drawn.
    pub sizes: [[u32; 2]; 2],
}

/// Lines that are written one after the other.
#[derive(Default)]
struct Lines(Vec<Line>);

impl Lines {
    fn text(&mut self, text: String) {
        self.0.push(Line::Text(text));
    }

    fn item(&mut self, text: String) {
        self.0.push(Line::Item(text));
    }

    fn row(&mut self, head: &str, text: &str) {
        let [head, text] = [head, text].map(ToOwned::to_owned);
        self.0.push(Line::Row { head, text });
    }

    fn gap(&mut self) {
        self.0.push(Line::Gap);
    }
}

/// How many mistakes a line names at most.
const NAMED: usize = 6;

/// How many scenes are named for the mistakes that this one cannot show.
const SCENES_NAMED: usize = 2;

/// Returns the answer to a question.
pub fn answer(asked: &Asked<'_>, found: &Diagnosis) -> Vec<Line> {
    let mut out = Lines::default();
    first_notes(asked, found, &mut out);
    verdict(asked, found, &mut out);
    cannot_show(found, &mut out);
    out.0
}

/// Writes notes on the file as a whole: its size, its background, its alpha, its encoding.
fn first_notes(asked: &Asked<'_>, found: &Diagnosis, out: &mut Lines) {
    let (name, sizes) = (asked.picture, asked.sizes);
    if sizes[0] != sizes[1] {
        let [own, drawn] = sizes.map(|[width, height]| format!("{width}x{height}"));
        let input = asked.scene;
        let line = format!(
            "{name} has {drawn} pixels, {input} {own}: the scene was drawn at the size of the picture."
        );
        out.text(line);
    }
    if found.is_transposed {
        let line = format!(
            "{name}: width and height are exchanged, and so are x and y. The rest of this answer is about the picture with that put right."
        );
        out.text(line);
    }
    if let Some(window) = found.window {
        out.text(format!("{name}: {}", shown(window)));
    }
    if let Some(rows) = found.rows {
        let line = format!(
            "{name}: {} The rest of this answer is about the picture with that put right.",
            laid_out(rows)
        );
        out.text(line);
    }
    if found.cracks > 0.0 {
        let share = 100.0 * found.cracks;
        let line = format!(
            "{name}: {share:.0} % of the covered pixels have the background's colour: cracks between polygons. The rest of this answer is about the other pixels."
        );
        out.text(line);
    }
    if let Some([own, stated]) = found.background {
        let [own, stated] = [own, stated].map(levels);
        let line = format!(
            "{name}: the background is {own}, but the scene says {stated}. The rest of this answer is about the other pixels."
        );
        out.text(line);
    }
    if found.is_premultiplied {
        let line = format!(
            "{name}: the colours of partly covered pixels are multiplied by their alpha; PNG stores colours without it. The rest of this answer is about the other pixels."
        );
        out.text(line);
    }
    if let Some(encoding) = found.stated_encoding {
        let stated = encoding.name();
        let line = format!(
            "{name}: the file says that it is {stated}, the scene says otherwise. The levels are compared without conversion."
        );
        out.text(line);
    }
    if !out.0.is_empty() {
        out.gap();
    }
}

/// Returns which part of the scene a file shows, and where.
fn shown(window: Window) -> String {
    let Window {
        in_scene: [left, top],
        in_file: [x, y],
        size: [width, height],
        scene,
    } = window;
    let place = format!("column {x}, row {y}");
    if [width, height] == scene {
        return format!("your picture is inside this one, at {place}.");
    }
    let (right, bottom) = (left + width - 1, top + height - 1);
    let part = format!("columns {left} to {right}, rows {top} to {bottom} of the scene's picture");
    if [x, y] == [0, 0] {
        format!("it shows {part}.")
    } else {
        format!("it shows {part}, from {place} on.")
    }
}

/// Returns how the rows of a file are laid out.
fn laid_out(rows: Rows) -> String {
    if rows.longer == 0 {
        let (fact, read) = (rows.bytes, 7 - rows.bytes);
        return format!("pixels have {fact} bytes each, but they were read as {read}.");
    }
    let by = counted(rows.longer.unsigned_abs().into(), "byte", "bytes");
    let more = if rows.longer > 0 { "longer" } else { "shorter" };
    let advice = match rows.order {
        Order::Bmp => "pad each row of a BMP to a multiple of 4 with (4 - 3w % 4) % 4",
        Order::Down | Order::Up => "check how many bytes lie between the starts of two rows",
    };
    format!("rows of the file are {by} {more} than they were read: {advice}.")
}

fn verdict(asked: &Asked<'_>, found: &Diagnosis, out: &mut Lines) {
    let name = asked.picture;
    let asked = match &asked.method {
        Some(method) => format!("{} drawn by {method}", asked.scene),
        None => asked.scene.to_owned(),
    };
    let off = off(found.reference.levels);
    match found.verdict {
        Verdict::Empty => {
            let line = format!(
                "{name} shows nothing of {asked}: where the scene should be, the picture has the colour of the background. Is the model behind the camera, outside the view, or culled?"
            );
            out.text(line);
        }
        Verdict::Correct => {
            let but = if found.is_correct() {
                ""
            } else {
                " apart from that"
            };
            let line = format!("{name} agrees with {asked}{but}: it is {off} off on average.");
            out.text(line);
            compared(found, out);
            if found.reference.levels >= 0.02 {
                look_at(found, out);
            }
        }
        Verdict::One => {
            out.text(format!("{name} is wrong, and one mistake explains it:"));
            out.gap();
            causes(found, out);
            evidence(found, out);
        }
        Verdict::Several => {
            let count = found.causes.first().map_or(2, |cause| cause.mistakes.len());
            let line = format!(
                "{name} is wrong, and {} mistakes together explain it. Correct them in this order:",
                in_words(count)
            );
            out.text(line);
            out.gap();
            steps(found, out);
            others(found, out);
            evidence(found, out);
        }
        Verdict::Partly => {
            let left = found.causes.first().map_or(0.0, |cause| cause.residual);
            out.text(format!(
                "{name} is wrong. This is part of it, but something else is wrong, too: {left:.2} of {off} are left."
            ));
            out.gap();
            causes(found, out);
            evidence(found, out);
            nearest(found, 1, out);
        }
        Verdict::Amounts => {
            let what = found.numbers.as_ref().map_or("numbers", subject_of);
            let besides = match found.numbers.as_ref().map_or(0, |n| n.mistakes.len()) {
                0 => "",
                1 => ", and there is a mistake besides",
                _ => ", and there are mistakes besides",
            };
            out.text(format!(
                "{name} is wrong: {what} differ from those in {asked}{besides}."
            ));
            out.gap();
            numbers(found, out);
            look_at(found, out);
        }
        Verdict::Tone => {
            let gamma = found.tone.map_or(1.0, |tone| tone.gamma);
            let line = format!(
                "{name} is wrong: its levels are those of {asked} after a curve, about (level/255)^{gamma:.2}. Store levels in the scene's `encoding`."
            );
            out.text(line);
            evidence(found, out);
        }
        Verdict::None => {
            let count = MISTAKES.len();
            let line = format!(
                "{name} is wrong, {off} off on average, and none of the {count} known mistakes explains it."
            );
            out.text(line);
            unexplained(found, out);
        }
    }
}

/// Returns hints for a picture that no mistake explains: where it is wrong, and which mistakes come
/// nearest.
fn unexplained(found: &Diagnosis, out: &mut Lines) {
    if found.outline > 0.1 {
        let share = 100.0 * found.outline;
        let line = format!(
            "The outlines differ by {share:.0} %. Does the picture show this scene, from this view? Check the camera first, then `rotate`, `translate` and `scale` of the objects."
        );
        out.text(line);
    }
    nearest(found, 3, out);
    if let Some([x, y, width, height]) = found.worst {
        let (right, bottom) = (x + width - 1, y + height - 1);
        out.row(
            "worst",
            &format!("columns {x} to {right}, rows {y} to {bottom}"),
        );
    }
    look_at(found, out);
}

/// Lists the mistakes that explain the picture best, and the other explanations that fit as well.
fn causes(found: &Diagnosis, out: &mut Lines) {
    for (place, cause) in found.causes.iter().take(6).enumerate() {
        for (which, mistake) in cause.mistakes.iter().enumerate() {
            let word = match (place, which) {
                (0, 0) => "",
                (_, 0) => "or: ",
                _ => "and: ",
            };
            out.item(format!("{word}{}", mistake.text));
        }
    }
    if found.causes.len() > 6 {
        out.item(format!(
            "or one of {} others (--json names them)",
            found.causes.len() - 6
        ));
    }
    tells_apart(found, out);
    out.gap();
}

/// Names a scene in which the two best explanations look different.
fn tells_apart(found: &Diagnosis, out: &mut Lines) {
    let [first, second, ..] = &found.causes[..] else {
        return;
    };
    let line = match scene_that_tells([first, second]) {
        Some(scene) => {
            format!("In this scene they look alike; a picture of `{scene}` would tell them apart.")
        }
        None => "They look alike in all shipped scenes.".to_owned(),
    };
    out.item(line);
}

fn evidence(found: &Diagnosis, out: &mut Lines) {
    let before = off(found.reference.levels);
    if let Some(cause) = found.causes.first() {
        let (after, mistakes) = (cause.residual, cause.word());
        let line = format!(
            "{before} off on average; {after:.2} are left if the reference makes the same {mistakes}"
        );
        out.row("evidence", &line);
    } else {
        out.row("evidence", &format!("{before} off on average"));
    }
    compared(found, out);
    look_at(found, out);
    // Each of the best explanations has its own advice. Steps have theirs already.
    let mut told = Vec::new();
    let explained = found.causes.iter().take(3);
    let explained = explained.filter(|_| found.verdict != Verdict::Several);
    for mistake in explained.flat_map(|cause| &cause.mistakes) {
        if !told.contains(&&mistake.fix) {
            out.row("what to do", &mistake.fix);
            out.row("read on", &mistake.read_on());
            told.push(&mistake.fix);
        }
    }
}

fn compared(found: &Diagnosis, out: &mut Lines) {
    let (compared, left_out) = (found.reference.compared, found.reference.left_out);
    let pixels = counted(compared, "pixel was", "pixels were");
    out.row(
        "compared",
        &format!(
            "{pixels} compared; {} at edges were left out",
            grouped(left_out)
        ),
    );
}

fn look_at(found: &Diagnosis, out: &mut Lines) {
    let Some(Spot {
        pixel: [x, y],
        yours,
        reference,
        explained,
    }) = found.look_at
    else {
        return;
    };
    let mut line = format!(
        "column {x}, row {y}: yours {}, the reference {}",
        levels(yours),
        levels(reference)
    );
    if let Some(explained) = explained {
        let mistakes = found.causes.first().map_or("mistake", Cause::word);
        line += &format!(", with the {mistakes} {}", levels(explained));
    }
    out.row("look at", &line);
}

/// Lists the single mistakes that come nearest without explaining the picture.
fn nearest(found: &Diagnosis, count: usize, out: &mut Lines) {
    let named = found
        .causes
        .first()
        .map_or("", |cause| &cause.mistakes[0].id);
    // A mistake that explains less than a quarter of the error is no hint.
    let most = 0.75 * found.reference.levels;
    let is_hint = |cause: &&Cause| cause.mistakes[0].id != named && cause.residual < most;
    for cause in found.singles.iter().filter(is_hint).take(count) {
        let line = format!(
            "{} It would leave an error of {:.2} levels.",
            cause.mistakes[0].text, cause.residual
        );
        out.row("nearest", &line);
    }
}

/// Names what differs in a picture that numbers explain.
fn subject_of(numbers: &Numbers) -> &'static str {
    if !numbers.lights.is_empty() {
        "the places of lights"
    } else if numbers.fog.is_some() {
        "fog and amounts of light"
    } else {
        "the amounts of light"
    }
}

/// Describes the numbers that explain a picture, and the mistakes besides.
fn numbers(found: &Diagnosis, out: &mut Lines) {
    let Some(numbers) = &found.numbers else {
        return;
    };
    for mistake in &numbers.mistakes {
        out.row("mistake", &mistake.text);
        out.row("what to do", &mistake.fix);
        out.row("read on", &mistake.read_on());
    }
    for light in &numbers.lights {
        out.row(&format!("light {}", light.index + 1), &light_line(light));
    }
    let mut factors: Vec<String> = numbers.amounts.iter().map(factor).collect();
    if numbers.has_other_exponent() {
        factors.push(format!("exponent × {:.2}", numbers.exponent));
    }
    if let Some(Fog {
        density, colour, ..
    }) = numbers.fog
    {
        let [r, g, b] = colour;
        out.row(
            "fog",
            &format!(
                "e^(−{density:.3} d) of the light passes at the distance d, the rest is the colour ({r:.2}, {g:.2}, {b:.2})"
            ),
        );
    }
    if !factors.is_empty() {
        out.row(
            "amounts",
            &format!("{}, the rest as in the scene", factors.join(", ")),
        );
    }
    let line = format!(
        "{} off on average; {:.2} are left if the reference has these numbers",
        off(found.reference.levels),
        numbers.residual
    );
    out.row("evidence", &line);
    compared(found, out);
}

fn light_line(light: &FittedLight) -> String {
    let triple = |v: [f64; 3]| {
        let [x, y, z] = v.map(|c| format!("{c:.2}"));
        format!("({x}, {y}, {z})")
    };
    let (from, unit) = if light.is_local {
        let places = [light.fitted, light.stated].map(|place| triple(place.to_array()));
        (places, "units")
    } else {
        let places = [light.fitted, light.stated].map(|v| triple(v.normalize_or_zero().to_array()));
        (places, "degrees")
    };
    let [fitted, stated] = from;
    let verb = if light.is_local {
        "is at"
    } else {
        "comes from"
    };
    let own = if light.is_local {
        "the scene's at"
    } else {
        "the scene's from"
    };
    let mut line = format!(
        "yours {verb} {fitted}, {own} {stated}: {:.1} {unit} apart",
        light.off
    );
    if let Some(name) = &light.name {
        line += &format!("; {name}");
    }
    line
}

fn factor(amount: &Amount) -> String {
    let mut line = String::from(amount.term);
    if let Some(light) = amount.light {
        let _ = write!(line, " of light {}", light + 1);
    }
    if let Some(material) = amount.material {
        let _ = write!(line, " of material {}", material + 1);
    }
    if let Some(channel) = amount.channel {
        let _ = write!(line, " in {}", ["red", "green", "blue"][channel.min(2)]);
    }
    let _ = match (amount.is_added, amount.has_diffuse_hue) {
        (true, _) => write!(line, " {:.3} in place of none", amount.factor),
        (false, true) => write!(line, " × {:.2} k_d", amount.factor),
        (false, false) => write!(line, " × {:.2}", amount.factor),
    };
    line
}

/// Lists the mistakes of the best explanation in the order in which they are best corrected, each
/// with what is left of the difference.
fn steps(found: &Diagnosis, out: &mut Lines) {
    let Some(cause) = found.causes.first() else {
        return;
    };
    let mut before = found.reference.levels;
    for (place, mistake) in cause.mistakes.iter().enumerate() {
        let after = cause.steps.get(place).map_or(0.0, |step| step.left);
        let line = format!("{} {before:.2} → {after:.2}", mistake.text);
        out.row(&format!("fix {}", place + 1), &line);
        out.row("", &format!("{} {}", mistake.fix, mistake.read_on()));
        before = after;
    }
    out.gap();
}

/// Lists the other explanations that fit as well as the best one.
fn others(found: &Diagnosis, out: &mut Lines) {
    let Some((first, rest)) = found.causes.split_first() else {
        return;
    };
    let before = out.0.len();
    for cause in rest.iter().take(NAMED - 1) {
        let other = |mistake: &&Mistake| !first.mistakes.iter().any(|own| own.id == mistake.id);
        let texts: Vec<&str> = cause
            .mistakes
            .iter()
            .filter(other)
            .map(|m| &*m.text)
            .collect();
        let missing = |mistake: &&Mistake| !cause.mistakes.iter().any(|own| own.id == mistake.id);
        let places = (1..)
            .zip(&first.mistakes)
            .filter(|(_, mistake)| missing(mistake));
        let places: Vec<String> = places.map(|(place, _)| place.to_string()).collect();
        out.item(format!(
            "or, for {}: {}",
            places.join(" and "),
            texts.join(" ")
        ));
    }
    if rest.len() >= NAMED {
        out.item(format!(
            "or one of {} others (--json names them)",
            rest.len() - NAMED + 1
        ));
    }
    tells_apart(found, out);
    if out.0.len() > before {
        out.gap();
    }
}

/// Returns a number up to nine in words.
fn in_words(count: usize) -> String {
    let words = [
        "two", "three", "four", "five", "six", "seven", "eight", "nine",
    ];
    let word = count.checked_sub(2).and_then(|place| words.get(place));
    word.map_or_else(|| count.to_string(), ToString::to_string)
}

/// Lists the mistakes that this scene cannot show, and scenes that can.
fn cannot_show(found: &Diagnosis, out: &mut Lines) {
    if found.invisible.is_empty() {
        return;
    }
    let mut by_scene: Vec<(&str, Vec<&str>)> = Vec::new();
    for mistake in &found.invisible {
        let best = scenes_that_show(&mistake.id)
            .first()
            .map(|(scene, _)| *scene);
        let scene = best.unwrap_or("(none shipped)");
        match by_scene.iter_mut().find(|(name, _)| *name == scene) {
            Some((_, ids)) => ids.push(&mistake.id),
            None => by_scene.push((scene, vec![&mistake.id])),
        }
    }
    by_scene.sort_by_key(|(_, ids)| core::cmp::Reverse(ids.len()));
    let count = found.invisible.len();
    let (one, more) = ("mistake", "mistakes");
    let head = format!(
        "This scene cannot show {}. Others can:",
        counted(count, one, more)
    );
    out.gap();
    out.text(head);
    for (scene, ids) in by_scene.iter().take(SCENES_NAMED) {
        let more = ids.len().saturating_sub(NAMED);
        let mut line = ids[..ids.len() - more].join(", ");
        if more > 0 {
            let _ = write!(line, " and {more} more");
        }
        out.row(scene, &line);
    }
    let others = by_scene.len().saturating_sub(SCENES_NAMED);
    if others > 0 {
        out.item(format!("and {others} more scenes: --json names all"));
    }
}

fn off(levels: f64) -> String {
    format!("{levels:.2} grey levels")
}

fn levels([r, g, b]: [f32; 3]) -> String {
    format!("{r:.0} {g:.0} {b:.0}")
}
