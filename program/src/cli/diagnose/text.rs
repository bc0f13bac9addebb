//! The answer as text: the mistake, its evidence, what to do, and which mistakes this scene cannot
//! show.

use super::super::text::{counted, grouped, wrapped};
use super::DiagnoseArgs;
use crate::diagnose::{Cause, Diagnosis, Spot, Verdict, scene_that_tells, scenes_that_show};
use std::fmt::Write;

/// How many mistakes a line names at most.
const NAMED: usize = 6;

/// How many scenes are named for the mistakes that this one cannot show.
const SCENES_NAMED: usize = 2;

/// Returns the answer. `sizes` are the scene's own size and the size at which it was drawn.
pub fn text(args: &DiagnoseArgs, found: &Diagnosis, sizes: [[u32; 2]; 2]) -> String {
    let mut text = first_notes(args, found, sizes);
    text += &verdict(args, found);
    let is_explained = !matches!(found.verdict, Verdict::None | Verdict::Empty);
    if found.cracks > 0.01 && is_explained {
        let share = 100.0 * found.cracks;
        let line = format!(
            "{share:.0} % of the pixels that the scene covers have the colour of the background: there are cracks between polygons, or polygons are missing."
        );
        text += &format!("\n{}", wrapped(&line, 0));
    }
    text + &cannot_show(found)
}

/// Returns notes on the file as a whole: its size, its background, its alpha, its encoding.
fn first_notes(args: &DiagnoseArgs, found: &Diagnosis, sizes: [[u32; 2]; 2]) -> String {
    let name = args.picture.display();
    let mut text = String::new();
    if sizes[0] != sizes[1] {
        let [own, drawn] = sizes.map(|[width, height]| format!("{width}x{height}"));
        let input = &args.input;
        let line = format!(
            "{name} has {drawn} pixels, {input} {own}: the scene was drawn at the size of the picture."
        );
        text += &wrapped(&line, 0);
    }
    if found.is_transposed {
        let line = format!(
            "{name}: width and height are exchanged, and so are x and y. The rest of this answer is about the picture with that put right."
        );
        text += &wrapped(&line, 0);
    }
    if let Some([own, stated]) = found.background {
        let [own, stated] = [own, stated].map(levels);
        let line = format!(
            "{name}: the background is {own}, but the scene says {stated}. The rest of this answer is about the other pixels."
        );
        text += &wrapped(&line, 0);
    }
    if found.is_premultiplied {
        let line = format!(
            "{name}: the colours of partly covered pixels are multiplied by their alpha; PNG stores colours without it. The rest of this answer is about the other pixels."
        );
        text += &wrapped(&line, 0);
    }
    if let Some(encoding) = found.stated_encoding {
        let stated = encoding.name();
        let line = format!(
            "{name}: the file says that it is {stated}, the scene says otherwise. The levels are compared without conversion."
        );
        text += &wrapped(&line, 0);
    }
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

fn verdict(args: &DiagnoseArgs, found: &Diagnosis) -> String {
    let name = args.picture.display();
    let asked = match &args.method {
        Some(method) => format!("{} drawn by {method}", args.input),
        None => args.input.clone(),
    };
    let off = off(found.reference.levels);
    match found.verdict {
        Verdict::Empty => {
            let line = format!(
                "{name} shows nothing of {asked}: where the scene should be, the picture has the colour of the background. Is the model behind the camera, outside the view, or culled?"
            );
            wrapped(&line, 0)
        }
        Verdict::Correct => {
            let but = if found.is_correct() {
                ""
            } else {
                " apart from that"
            };
            let line = format!("{name} agrees with {asked}{but}: it is {off} off on average.");
            let is_exact = found.reference.levels < 0.02;
            let most = if is_exact {
                String::new()
            } else {
                look_at(found)
            };
            wrapped(&line, 0) + &compared(found) + &most
        }
        Verdict::One => {
            let mut text = format!("{name} is wrong, and one mistake explains it:\n\n");
            text += &causes(found);
            text + &evidence(found)
        }
        Verdict::Several => {
            let count = found.causes.first().map_or(2, |cause| cause.mistakes.len());
            let count = if count == 2 { "two" } else { "three" };
            let mut text =
                format!("{name} is wrong, and {count} mistakes together explain it:\n\n");
            text += &causes(found);
            text + &evidence(found)
        }
        Verdict::Partly => {
            let mut text = format!(
                "{name} is wrong. This explains most of it, but something else is wrong too:\n\n"
            );
            text += &causes(found);
            text + &evidence(found) + &nearest(found, 1)
        }
        Verdict::Amounts => {
            let line =
                format!("{name} is wrong: the amounts of light differ from those in {asked}.");
            wrapped(&line, 0) + &amounts(found) + &look_at(found)
        }
        Verdict::Tone => {
            let gamma = found.tone.map_or(1.0, |tone| tone.gamma);
            let line = format!(
                "{name} is wrong: its levels are those of {asked} after a curve, about (level/255)^{gamma:.2}. Store levels in the scene's `encoding`."
            );
            wrapped(&line, 0) + &evidence(found)
        }
        Verdict::None => {
            let count = found.singles.len();
            let line = format!(
                "{name} is wrong, {off} off on average, and none of the {count} known mistakes explains it."
            );
            wrapped(&line, 0) + &unexplained(found)
        }
    }
}

/// Returns hints for a picture that no mistake explains: where it is wrong, and which mistakes come
/// nearest.
fn unexplained(found: &Diagnosis) -> String {
    let mut text = String::new();
    if found.outline > 0.1 {
        let share = 100.0 * found.outline;
        let line = format!(
            "The outlines differ by {share:.0} %. Does the picture show this scene, from this view? Check the camera first, then `rotate`, `translate` and `scale` of the objects."
        );
        text += &wrapped(&line, 0);
    }
    text += &nearest(found, 3);
    if let Some([x, y, width, height]) = found.worst {
        let (right, bottom) = (x + width - 1, y + height - 1);
        text += &row(
            "worst",
            &format!("columns {x} to {right}, rows {y} to {bottom}"),
        );
    }
    text + &look_at(found) + &amounts(found)
}

/// Lists the mistakes that explain the picture best, and the other explanations that fit as well.
fn causes(found: &Diagnosis) -> String {
    let mut text = String::new();
    for (place, cause) in found.causes.iter().take(6).enumerate() {
        for (which, mistake) in cause.mistakes.iter().enumerate() {
            let word = match (place, which) {
                (0, 0) => "",
                (_, 0) => "or: ",
                _ => "and: ",
            };
            text += &wrapped(&format!("{word}{}", mistake.text), 2);
        }
    }
    if found.causes.len() > 6 {
        text += &format!(
            "  or one of {} others (--json names them)\n",
            found.causes.len() - 6
        );
    }
    if let [first, second, ..] = &found.causes[..] {
        let line = match scene_that_tells([first, second]) {
            Some(scene) => format!(
                "In this scene they look alike; a picture of `{scene}` would tell them apart."
            ),
            None => "They look alike in all shipped scenes.".to_owned(),
        };
        text += &wrapped(&line, 2);
    }
    text.push('\n');
    text
}

fn evidence(found: &Diagnosis) -> String {
    let mut text = String::new();
    let before = off(found.reference.levels);
    if let Some(cause) = found.causes.first() {
        let after = cause.residual;
        let line = format!(
            "{before} off on average; {after:.2} are left if the reference makes the same mistake"
        );
        text += &row("evidence", &line);
    } else {
        text += &row("evidence", &format!("{before} off on average"));
    }
    text += &compared(found);
    text += &look_at(found);
    // Each of the best explanations has its own advice.
    let mut told = Vec::new();
    for mistake in found
        .causes
        .iter()
        .take(3)
        .flat_map(|cause| &cause.mistakes)
    {
        if !told.contains(&&mistake.fix) {
            text += &row("what to do", &mistake.fix);
            text += &row("read on", &mistake.read_on());
            told.push(&mistake.fix);
        }
    }
    text
}

fn compared(found: &Diagnosis) -> String {
    let (compared, left_out) = (found.reference.compared, found.reference.left_out);
    let pixels = counted(compared, "pixel was", "pixels were");
    row(
        "compared",
        &format!(
            "{pixels} compared; {} at edges were left out",
            grouped(left_out)
        ),
    )
}

fn look_at(found: &Diagnosis) -> String {
    let Some(Spot {
        pixel: [x, y],
        yours,
        reference,
        explained,
    }) = found.look_at
    else {
        return String::new();
    };
    let mut line = format!(
        "column {x}, row {y}: yours {}, the reference {}",
        levels(yours),
        levels(reference)
    );
    if let Some(explained) = explained {
        line += &format!(", with the mistake {}", levels(explained));
    }
    row("look at", &line)
}

/// Lists the single mistakes that come nearest without explaining the picture.
fn nearest(found: &Diagnosis, count: usize) -> String {
    let named = found
        .causes
        .first()
        .map_or("", |cause| &cause.mistakes[0].id);
    // A mistake that explains less than a quarter of the error is no hint.
    let most = 0.75 * found.reference.levels;
    let is_hint = |cause: &&Cause| cause.mistakes[0].id != named && cause.residual < most;
    let mut text = String::new();
    for cause in found.singles.iter().filter(is_hint).take(count) {
        let line = format!(
            "{} It would leave an error of {:.2} levels.",
            cause.mistakes[0].text, cause.residual
        );
        text += &row("nearest", &line);
    }
    text
}

fn amounts(found: &Diagnosis) -> String {
    let Some(amounts) = found.amounts else {
        return String::new();
    };
    let all: Vec<String> = amounts
        .wrong()
        .iter()
        .map(|(name, by)| format!("{name} × {by:.2}"))
        .collect();
    let line = format!(
        "{}, the rest as in the scene: this would leave an error of {:.2} levels",
        all.join(", "),
        amounts.residual
    );
    row("amounts", &line)
}

/// Lists the mistakes that this scene cannot show, and scenes that can.
fn cannot_show(found: &Diagnosis) -> String {
    if found.invisible.is_empty() {
        return String::new();
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
    by_scene.sort_by_key(|(_, ids)| std::cmp::Reverse(ids.len()));
    let count = found.invisible.len();
    let (one, more) = ("mistake", "mistakes");
    let head = format!(
        "This scene cannot show {}. Others can:",
        counted(count, one, more)
    );
    let mut text = format!("\n{head}\n");
    for (scene, ids) in by_scene.iter().take(SCENES_NAMED) {
        let more = ids.len().saturating_sub(NAMED);
        let mut line = ids[..ids.len() - more].join(", ");
        if more > 0 {
            let _ = write!(line, " and {more} more");
        }
        text += &row(scene, &line);
    }
    let others = by_scene.len().saturating_sub(SCENES_NAMED);
    if others > 0 {
        text += &format!("  and {others} more scenes: --json names all\n");
    }
    text
}

/// Writes a heading, and beside it a text wrapped into one column.
fn row(head: &str, line: &str) -> String {
    const COLUMN: usize = 22;
    let text = wrapped(line, COLUMN);
    let head = format!("  {head:<width$}", width = COLUMN - 2);
    format!("{head}{}", text.trim_start())
}

fn off(levels: f64) -> String {
    format!("{levels:.2} grey levels")
}

fn levels([r, g, b]: [f32; 3]) -> String {
    format!("{r:.0} {g:.0} {b:.0}")
}
