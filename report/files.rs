//! The files that the package `fastphong-cli` puts into its report, as constants.
//!
//! Nothing here is a stable interface.
#![no_std]

/// The template of the page.
pub const TEMPLATE: &str = include_str!("template.html");
/// The template of a viewer, which the script clones.
pub const VIEWER: &str = include_str!("viewer.html");
/// The style of all pages.
pub const STYLE: &str = include_str!("app.css");

/// The template of the page of compared pictures.
pub const PAIRS_TEMPLATE: &str = include_str!("pairs/page.html");
/// What the page of compared pictures adds to the style.
pub const PAIRS_STYLE: &str = include_str!("pairs/style.css");

/// The library, compiled to WebAssembly by `live/build`.
pub static MODULE: &[u8] = include_bytes!("live.wasm");

/// The measurements of `examples/small/run`, as JSON.
pub const SMALL: &str = include_str!("small.json");

/// The summary of a report that was measured on a quiet machine, as JSON. `docs/findings/run` makes
/// the report, and `tests/documents/findings.rs` the summary.
pub const QUIET: &str = include_str!("quiet.json");

/// Lists files of `script` with their texts.
macro_rules! script {
    ($($file:literal)*) => {
        &[$((concat!($file, ".js"), include_str!(concat!("script/", $file, ".js")))),*]
    };
}

/// The files of the script, ES modules, with their texts, in any order.
pub static SCRIPT: &[(&str, &str)] = script!(
    "address" "beside" "charts" "controls" "corners" "costs" "course" "data" "errors" "figure"
    "findings" "formulas" "goals" "growth" "hands" "keys" "lectures" "link" "live" "marks" "markup"
    "measured" "methods" "numbers" "overview" "page" "pairs" "pareto" "pictures" "plot" "probe"
    "questions" "row" "scene-table" "scene-viewer" "scenes" "small" "speed" "spheres" "steps"
    "stop-ask" "stop-panel" "stop-stage" "stop-strip" "stop-words" "stop" "studio" "terms" "theme"
    "traces" "turn" "viewer" "views"
);

/// Lists chapters: the part of the lecture, the file, and its text.
macro_rules! chapters {
    ($($part:literal in $file:literal)*) => {
        &[$(($part, $file, include_str!(concat!("course/", $file)))),*]
    };
}

/// The chapters of the course in order: the section of the lecture or a name, the name of the file,
/// and its text in Markdown.
pub static CHAPTERS: &[(&str, &str, &str)] = chapters!(
    "0" in "0-one-scan-line.md"
    "1" in "1-introduction.md"
    "2" in "2-uniform-shading.md"
    "3" in "3-gouraud-shading.md"
    "4.1" in "4.1-naive-phong-shading.md"
    "4.2" in "4.2-diffuse-reflection.md"
    "4.3" in "4.3-specular-reflection.md"
    "4.4" in "4.4-spherical-interpolation.md"
    "5" in "5-summary.md"
    "teaching" in "teaching.md"
);
