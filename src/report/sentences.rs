//! Sentences whose words are chosen by what was measured.

use super::section::Section;
use super::summary::{Tally, worst_error};
use crate::compare::timing::Machine;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// True if fast and slerp Phong shading beat naive Phong shading here, one sentence or two each; then what else a reader
/// should know before the numbers.
pub(super) fn opening(sections: &[Section], machine: &Machine) -> Vec<String> {
    let mut sentences = Vec::new();
    for (method, name) in [
        ("fast-phong", "Fast Phong shading"),
        ("slerp-phong", "Slerp Phong shading"),
    ] {
        if let Some(tally) = Tally::of(method, sections) {
            sentences.push(against_naive(name, &tally));
            sentences.extend(error(method, sections));
        }
    }
    if let Some(tally) = Tally::of("gouraud", sections) {
        sentences.extend(gouraud(&tally, sections));
    }
    if sections
        .iter()
        .all(|section| section.all_rows().all(|row| row.speed.is_none()))
    {
        sentences.push("No times were taken: this report tells of errors only.".to_string());
    } else if machine.profile != "release" {
        sentences.push(
            "This program was built without optimisation: its times say nothing of the methods."
                .to_string(),
        );
    } else {
        sentences.extend(unrest(sections));
    }
    sentences
}

/// What to think of the times if the machine had other things to do: the middle half of the samples of a quiet one lies
/// within a few hundredths of their median.
fn unrest(sections: &[Section]) -> Option<String> {
    const QUIET: f64 = 0.1;
    let rows = sections.iter().flat_map(|section| section.all_rows());
    let mut spreads: Vec<f64> = rows
        .filter_map(|row| Some(row.speed.as_ref()?.timing.spread))
        .collect();
    spreads.sort_by(f64::total_cmp);
    let median = *spreads.get(spreads.len() / 2)?;
    (median > QUIET).then(|| {
        let percent = libm::round(100.0 * median);
        format!(
            "The machine was busy with other things as well: the middle half of the samples of a time typically spreads \
             over {percent} % of it, and what intervals cannot tell apart should be measured again on a quiet machine."
        )
    })
}

/// How the method called `name` fares against naive Phong.
fn against_naive(name: &str, tally: &Tally<'_>) -> String {
    let scenes = tally.scenes();
    let verdict = match tally {
        _ if 2 * tally.faster > scenes && tally.mean > 1.0 => "beats naive Phong shading here",
        _ if 2 * tally.slower > scenes && tally.mean < 1.0 => {
            "does not beat naive Phong shading here"
        }
        _ if tally.ties == scenes => "cannot be told from naive Phong shading by its speed here",
        _ => "neither clearly beats naive Phong shading here nor clearly loses to it",
    };
    let scene_count = count(scenes, "scene");
    let detail = match (tally.faster, tally.slower, tally.ties) {
        (f, 0, 0) if f > 1 => format!("it is faster in all {scene_count}"),
        (0, s, 0) if s > 1 => format!("it is slower in all {scene_count}"),
        (0, 0, t) if t > 1 => {
            format!("the 95 % interval of the ratio holds 1 in all {scene_count}")
        }
        (1, 0, 0) => "it is faster in the one scene compared".to_string(),
        (0, 1, 0) => "it is slower in the one scene compared".to_string(),
        (0, 0, 1) => "the 95 % interval of the ratio holds 1 in the one scene compared".to_string(),
        (faster, slower, ties) => {
            let parts = [(faster, "faster"), (slower, "slower"), (ties, "level")];
            let parts: Vec<String> = parts
                .iter()
                .filter(|(n, _)| *n > 0)
                .map(|(n, word)| format!("{word} in {n}"))
                .collect();
            format!("of {scene_count} it is {}", enumeration(&parts))
        }
    };
    let Tally {
        mean, best, worst, ..
    } = tally;
    if scenes == 1 {
        return format!("{name} {verdict}: {detail}, {}.", times_as_fast(*mean));
    }
    format!(
        "{name} {verdict}: {detail}, and {} by the geometric mean, from {:.2} ({}) to {:.2} ({}).",
        times_as_fast(*mean),
        worst.0,
        worst.1,
        best.0,
        best.1
    )
}

fn times_as_fast(ratio: f64) -> String {
    format!("{ratio:.2} times as fast")
}

/// How far a method's pictures are from the reference, beside those of naive Phong.
fn error(method: &str, sections: &[Section]) -> Option<String> {
    let (worst, scene) = worst_error(method, sections)?;
    let (naive, _) = worst_error("naive-phong", sections)?;
    let off = levels(worst);
    Some(if sections.len() == 1 {
        format!(
            "Its largest error is {off} (naive Phong: {}).",
            levels(naive)
        )
    } else {
        format!(
            "Its largest error in any of them is {off} ({scene}; naive Phong at most {}).",
            levels(naive)
        )
    })
}

fn gouraud(tally: &Tally<'_>, sections: &[Section]) -> Option<String> {
    let (worst, scene) = worst_error("gouraud", sections)?;
    let speed = times_as_fast(tally.mean);
    let price = if tally.mean > 1.0 {
        "for errors of up to"
    } else {
        "and has errors of up to"
    };
    let place = if sections.len() == 1 {
        String::new()
    } else {
        format!(" ({scene})")
    };
    Some(format!(
        "Gouraud shading is {speed} as naive Phong, {price} {}{place}.",
        levels(worst)
    ))
}

/// An error in grey levels, with as many digits as it deserves.
fn levels(error: f64) -> String {
    let levels = 255.0 * error;
    let number = match levels {
        0.0 => return "none".to_string(),
        l if l < 0.01 => return "less than 0.01 grey levels".to_string(),
        l if l < 10.0 => format!("{l:.2}"),
        l => format!("{l:.0}"),
    };
    format!("{number} grey levels")
}

/// `1 scene`, `2 scenes`; thousands are grouped.
pub(super) fn count(n: usize, one: &str) -> String {
    format!("{} {one}{}", grouped(n), if n == 1 { "" } else { "s" })
}

/// `1234567` as `1,234,567`.
pub(super) fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

pub(super) fn enumeration(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// What a scene consists of, and what became of its polygons.
pub(super) fn facts(section: &Section) -> String {
    let d = &section.data;
    let share = 100.0 * d.covered_pixels as f64 / (d.width * d.height).max(1) as f64;
    let mut text = format!(
        "{} × {} pixels, {}",
        d.width,
        d.height,
        count(d.polygons, "polygon")
    );
    if d.triangles != d.polygons {
        text.push_str(&format!(" worth {}", count(d.triangles, "triangle")));
    }
    text.push_str(&format!(
        ", {}; {} ({share:.1} %) covered",
        count(d.lights, "light"),
        count(d.covered_pixels, "pixel")
    ));
    if d.covered_pixels > 0 {
        text.push_str(&format!(
            ", {:.2} times on average",
            d.fragments as f64 / d.covered_pixels as f64
        ));
    }
    text.push_str(&format!(
        ". Attributes vary linearly {}",
        if d.interpolation == "screen" {
            "on the screen"
        } else {
            "in space"
        }
    ));
    if d.encoding == "srgb" {
        text.push_str("; pictures are stored as sRGB, errors are of linear light");
    }
    text.push('.');
    let left_out = [
        (d.stats.zero_area, "without area"),
        (d.stats.culled, "seen from the culled side"),
        (d.stats.outside, "outside the view"),
        (d.stats.unprojected, "with a corner at the plane of the eye"),
    ];
    let left_out: Vec<String> = left_out
        .iter()
        .filter(|(n, _)| *n > 0)
        .map(|(n, why)| format!("{} {why}", grouped(*n)))
        .collect();
    if !left_out.is_empty() {
        text.push_str(&format!(
            " Of {} in the scene were left out: {}.",
            count(d.stats.polygons, "polygon"),
            enumeration(&left_out)
        ));
    }
    if d.stats.clipped > 0 {
        text.push_str(&format!(" {} clipped.", count(d.stats.clipped, "polygon")));
    }
    text
}

/// How far the polygons' reference lies from that of triangles.
pub(super) fn orientation(section: &Section) -> Option<String> {
    let t = section.triangulation?;
    let d = &t.difference.difference;
    let polygons = count(section.data.polygons, "polygon");
    let cut = format!(
        "Cut into {}, the {polygons} of this scene",
        count(t.triangles, "triangle")
    );
    let mut text = if t.difference.equal || 255.0 * d.max < 0.01 {
        format!("{cut} keep their reference picture: nothing here depends on their orientation.")
    } else {
        let [max, rms] = [d.max, d.rms].map(levels);
        format!(
            "{cut} have another reference picture: it differs by up to {max}, {rms} RMS. That much of Phong shading \
                 depends on the orientation of polygons of four corners or more (L21 3, Figure 5)."
        )
    };
    if t.not_simple > 0 {
        text.push_str(&format!(
            " {} crossing themselves were left out.",
            count(t.not_simple, "polygon")
        ));
    }
    Some(text)
}
