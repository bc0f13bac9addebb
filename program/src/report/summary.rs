//! The summary of a run: what every method gets wrong and how fast it is, in a few kilobytes.
//!
//! Every answer is made from a summary, so all places give one answer to one run.
//! `report/quiet.json` holds the summary of a run on a quiet machine.

use super::document::{list, number, text, title};
use crate::compare::timing::Ratio;
use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The errors and the speeds of all methods in one run.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Summary {
    /// The machine.
    pub machine: Computer,
    /// The day in UTC, as in `2026-11-28`.
    pub date: Option<String>,
    /// The command line as typed, with the program first.
    pub command_line: Vec<String>,
    /// The count of scenes.
    pub scenes: usize,
    /// The methods that were drawn by scanlines in all scenes, in the order of the document.
    pub methods: Vec<MethodError>,
    /// Whole frames in scalar code; `None` if they were not drawn.
    pub scalar: Option<Speeds>,
    /// Whole frames with SIMD: the scenes, if they were drawn with SIMD, otherwise the sphere of
    /// the experiment `speedups`. `None` if neither was drawn.
    pub simd: Option<Speeds>,
}

/// The machine and the build of a run.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Computer {
    /// The processor.
    pub cpu: String,
    /// The operating system.
    pub os: String,
    /// The architecture.
    pub arch: String,
    /// The compiler.
    pub rustc: String,
    /// The profile of the build. Times of others than `release` say nothing.
    pub profile: String,
}

/// The largest error of a method.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct MethodError {
    /// The variant.
    pub variant: String,
    /// The largest error in any scene, in grey levels.
    pub levels: f64,
    /// The title of the scene with this error.
    pub scene: String,
    /// The index of that scene.
    #[serde(skip)]
    pub place: usize,
}

/// The speeds of methods in one kind of code.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Speeds {
    /// The instruction set.
    pub level: String,
    /// The frames: `over 22 scenes`, `in this scene`, `on one sphere`.
    pub frames: String,
    /// The reason why the speeds are withheld, as a sentence, if the machine was too busy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub too_busy: Option<String>,
    /// The methods that were timed in all frames.
    pub methods: Vec<MethodSpeed>,
}

/// The speed of a method, and the error that decides whether it draws naive Phong's picture.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct MethodSpeed {
    /// The variant.
    pub variant: String,
    /// The largest error in grey levels: in any scene, or for a method without scenes on the
    /// experiment's sphere.
    pub levels: f64,
    /// The speed as a multiple of naive Phong's: the geometric means of typical values and of the
    /// ends of intervals over all frames.
    #[serde(flatten)]
    pub speed: Ratio,
}

impl Summary {
    /// Summarises a document.
    pub fn of(data: &Value) -> Summary {
        let scenes: Vec<&Value> = list(data, "/comparisons").iter().collect();
        let methods = errors(&scenes);
        let level = |scene: &Value| text(scene, "/renderer/level").to_string();
        // A comparison of several instruction sets has the best one last.
        let levels = scenes.iter().map(|scene| level(scene));
        let wide = levels.rev().find(|level| level != SCALAR);
        let drawn_in = |code: &str| {
            let those = scenes.iter().filter(|scene| level(scene) == code);
            let those: Vec<&Value> = those.copied().collect();
            (!those.is_empty()).then(|| of_scenes(&those, code, &methods))
        };
        let m = |field: &str| text(&data["machine"], field).to_string();
        let words = list(data, "/command_line").iter();
        Summary {
            machine: Computer {
                cpu: m("/cpu"),
                os: m("/os"),
                arch: m("/arch"),
                rustc: m("/rustc"),
                profile: m("/profile"),
            },
            date: data["date"].as_str().map(String::from),
            command_line: words.map(|word| text(word, "").to_string()).collect(),
            scenes: distinct(&scenes),
            scalar: drawn_in(SCALAR),
            simd: wide
                .and_then(|level| drawn_in(&level))
                .or_else(|| of_speedups(&data["speedups"], &methods)),
            methods,
        }
    }

    /// True if the program was built with optimisation. Otherwise its times say nothing.
    pub(super) fn is_optimised(&self) -> bool {
        self.machine.profile == "release"
    }
}

/// Counts scenes. A scene may be compared on several instruction sets.
fn distinct(scenes: &[&Value]) -> usize {
    let names: BTreeSet<&str> = scenes.iter().map(|scene| title(scene)).collect();
    names.len()
}

/// The instruction set without SIMD.
pub(super) const SCALAR: &str = "scalar";

/// Returns the largest errors of all methods that were drawn in all scenes.
fn errors(scenes: &[&Value]) -> Vec<MethodError> {
    let names = names(scenes).map(|name| {
        let found = scenes.iter().enumerate().map(|(place, scene)| {
            let levels = 255.0 * number(row(scene, name)?, "/error/max")?;
            Some((place, levels))
        });
        let found: Option<Vec<(usize, f64)>> = found.collect();
        let (place, levels) = found?.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(MethodError {
            variant: name.to_string(),
            levels,
            scene: title(scenes[place]).to_string(),
            place,
        })
    });
    names.flatten().collect()
}

fn names<'a>(scenes: &[&'a Value]) -> impl Iterator<Item = &'a str> {
    let rows = scenes.first().map_or(&[][..], |scene| list(scene, "/rows"));
    rows.iter().map(|row| text(row, "/variant"))
}

fn row<'a>(scene: &'a Value, name: &str) -> Option<&'a Value> {
    let mut rows = list(scene, "/rows").iter();
    rows.find(|row| text(row, "/variant") == name)
}

/// Summarises the speeds of scenes, which were drawn in one kind of code. Leaves out scenes for
/// which the machine was too busy, if these are at most half of them.
pub(super) fn of_scenes(scenes: &[&Value], level: &str, errors: &[MethodError]) -> Speeds {
    let is_told = |scene: &&&Value| !is_too_busy(&scene["noise"]);
    let mut told: Vec<&Value> = scenes.iter().filter(is_told).copied().collect();
    let is_answer = 2 * told.len() >= scenes.len();
    if !is_answer {
        told = scenes.to_vec();
    }
    let methods = errors.iter().filter_map(|error| {
        let speed =
            |scene: &&Value| ratio_of(&row(scene, &error.variant)?["speed"]["ratio_to_naive"]);
        let speeds: Option<Vec<Ratio>> = told.iter().map(speed).collect();
        Some(MethodSpeed {
            variant: error.variant.clone(),
            levels: error.levels,
            speed: Ratio::mean(&speeds?),
        })
    });
    Speeds {
        level: level.to_string(),
        frames: match scenes.len() {
            1 => "in this scene".to_string(),
            count if told.len() == count => format!("over {count} scenes"),
            count => format!("over {} of {count} scenes", told.len()),
        },
        too_busy: too_busy(scenes.iter().map(|scene| &scene["noise"])).filter(|_| !is_answer),
        methods: methods.collect(),
    }
}

/// Summarises the corner of whole frames with SIMD.
///
/// The pictures of all scenes decide whether a method draws naive Phong's picture. For a method
/// that was not drawn there, the experiment's sphere decides.
fn of_speedups(speedups: &Value, errors: &[MethodError]) -> Option<Speeds> {
    let is_it =
        |c: &Value| c["work"] == "frame" && c["scalar"] == false && text(c, "/level") != SCALAR;
    let corner = list(speedups, "/corners").iter().position(is_it)?;
    let methods = list(speedups, "/methods").iter().filter_map(|method| {
        let variant = text(method, "/method").to_string();
        let drawn = errors.iter().find(|error| error.variant == variant);
        let on_sphere = || number(method, "/levels_off");
        Some(MethodSpeed {
            levels: drawn.map(|error| error.levels).or_else(on_sphere)?,
            speed: ratio_of(&method["corners"][corner]["ratio_to_naive"])?,
            variant,
        })
    });
    Some(Speeds {
        level: text(&speedups["corners"][corner], "/level").to_string(),
        frames: "on one sphere".to_string(),
        too_busy: too_busy([&speedups["noise"]].into_iter()),
        methods: methods.collect(),
    })
}

/// True if the speeds of frames with this noise are to be withheld.
pub(super) fn is_too_busy(noise: &Value) -> bool {
    noise["trust"] == "too-busy"
}

/// Says why the speeds of frames with these noises are withheld. Returns `None` if the machine was
/// too busy in none of them.
fn too_busy<'a>(noises: impl Iterator<Item = &'a Value>) -> Option<String> {
    let interrupted = |noise: &&Value| number(noise, "/interrupted").unwrap_or(0.0);
    let those = noises.filter(|noise| is_too_busy(noise));
    let worst = those.max_by(|a, b| interrupted(a).total_cmp(&interrupted(b)))?;
    let sentence = text(worst, "/sentence");
    let mut letters = sentence.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    let capitalised: String = first.into_iter().chain(letters).collect();
    Some(format!("{capitalised}."))
}

/// Reads a ratio of a document.
pub(super) fn ratio_of(value: &Value) -> Option<Ratio> {
    Ratio::deserialize(value).ok()
}
