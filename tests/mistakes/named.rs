//! `fastphong diagnose` names the mistakes of these pictures.
//!
//! A usual run tries one of 200 pictures, and none of `knot-100k`. This command tries all of them
//! and prints a line for each picture whose mistake is not named:
//!
//! ```sh
//! FASTPHONG_MISTAKES=1 cargo test --release --test mistakes named -- --nocapture
//! ```

use crate::draw::draw;
use crate::mistakes::{MISTAKES, Mistake, can_be_combined};
use crate::picture::Picture;
use crate::scenes::scenes;
use crate::variation::{Edges, Filling, Variation};
use fastphong::picture;
use fastphong::picture::image_file::FilePicture;
use fastphong::scene::Scene;
use fastphong_cli::diagnose::{Diagnosis, Question, Verdict, diagnose};
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::thread;

/// Returns the names under which `diagnose` knows a mistake of this table. A diagnosis must contain
/// one of them. The list is empty for a mistake that `diagnose` does not know.
pub fn names(mistake: &str) -> &'static [&'static str] {
    match mistake {
        "light-negated" => &["light-reversed", "normals-reversed"],
        "light-position-alone" => &["position-as-direction"],
        "light-not-unit" => &["light-not-normalised"],
        "light-in-eye-space" => &["light-in-view-space", "light-positions-turned"],
        "light-colour-ignored" => &["light-colour-missing", "light-white"],
        "materials-first-of-mesh" | "materials-of-first-object" => &["one-material"],
        "lights-first-only" => &["first-light-only"],
        "lights-last-only" => &["last-light-only"],
        "lights-mean" => &["lights-averaged"],
        "ambient-missing" => &["ambient-missing"],
        "ambient-per-light" => &["ambient-per-light"],
        "ambient-without-ka" => &["ambient-without-material"],
        "ambient-without-ia" => &["ambient-without-light"],
        "diffuse-not-clamped" => &["diffuse-unclamped"],
        "diffuse-absolute" => &["diffuse-absolute"],
        "diffuse-half" => &["half-lambert"],
        "diffuse-missing" => &["diffuse-missing"],
        "specular-missing" => &["specular-missing"],
        "specular-times-kd" => &["specular-diffuse-colour"],
        "specular-without-light-colour" => &["highlight-white"],
        "highlight-other-model" => &["other-highlight", "other-highlight-converted"],
        "reflection-negated" => &["reflection-reversed", "view-reversed"],
        "reflection-without-two" => &["reflection-without-2"],
        "half-vector-not-unit" => &["halfway-not-normalised"],
        "half-vector-mean" => &["halfway-mean"],
        "gate-missing" => &["highlight-behind"],
        "highlight-times-diffuse" => &["highlight-times-cosine"],
        "specular-not-clamped" => &["highlight-unclamped"],
        "exponent-missing" => &["exponent-missing"],
        "exponent-not-converted" => &["exponent-quartered", "exponent-fourfold"],
        "exponent-divided" => &[
            "exponent-quartered",
            "exponent-fourfold",
            "exponent-sixteenth",
        ],
        "view-negated" => &["view-reversed", "reflection-reversed"],
        "view-at-eye" | "view-far-away" => &["viewer-distance"],
        "falloff-missing" => &["falloff-missing"],
        "falloff-not-squared" => &["falloff-linear"],
        "falloff-inverse-square" => &["falloff-inverse-square"],
        "gouraud" => &["per-vertex", "per-vertex-unclamped"],
        "flat" => &["per-face", "normals-of-faces"],
        "flat-first-vertex" => &["per-face-first-vertex"],
        "flat-mean-normal" => &["per-face-mean"],
        "normal-not-normalised" => &["normals-not-normalised"],
        "normal-not-normalised-but-reflection" => &["normals-not-normalised-but-r"],
        "interpolation-on-screen" => &["other-interpolation"],
        "normal-faces-viewer" => &["normals-toward-viewer"],
        "normals-reversed" => &["normals-reversed", "light-reversed"],
        "normals-area-weighted" => &["normals-by-area"],
        "normals-angle-weighted" => &["normals-by-angle"],
        "normals-sum-kept" => &["normals-sums"],
        "given-normals-ignored" | "crease-ignored" => {
            &["normals-over-position", "normals-by-index"]
        }
        "normals-by-matrix" => &["normals-by-matrix"],
        "normals-not-transformed" => &["normals-of-model"],
        "fov-in-degrees" => &["fov-in-radians"],
        "fov-not-halved" => &["fov-doubled"],
        "fov-horizontal" => &["fov-horizontal"],
        "aspect-on-height" => &["aspect-on-height"],
        "normal-not-normalised-in-highlights" => &["normals-not-normalised-in-highlights"],
        // Terms that are wrong by a factor.
        "diffuse-over-pi" => &["diffuse-over-pi"],
        "specular-energy" => &["highlight-normalised-for-h"],
        "light-colour-of-first" => &["light-colour-of-first"],
        "ambient-times-kd" => &["ambient-diffuse-colour"],
        "ambient-attenuated" => &["ambient-with-falloff"],
        "highlight-n-dot-v" => &["highlight-n-v"],
        "highlight-n-dot-l" => &["highlight-n-l"],
        "reflection-of-view" => &["reflection-of-view"],
        "half-vector-difference" => &["halfway-difference"],
        "exponent-as-factor" => &["exponent-as-factor"],
        "exponent-128" => &["exponent-times-128", "specular-missing"],
        "exponent-of-product" => &["power-of-product", "specular-missing"],
        "view-along-z" => &["view-along-z"],
        "view-toward-origin" => &["view-toward-origin"],
        "view-not-unit" => &["view-not-normalised"],
        "falloff-multiplied" => &["falloff-multiplied"],
        "falloff-diffuse-only" => &["falloff-diffuse-only"],
        "weights-rotated" => &["weights-of-next-corner", "weights-of-corner-before"],
        "interpolation-times-w" => &["interpolation-times-w"],
        "normals-of-first-corner" => &["normals-of-first-edges"],
        "normals-last-polygon" => &["normals-of-last-polygon"],
        "normals-each-triangle" => &["normals-of-triangles"],
        "given-normals-used" => &["normals-of-file"],
        "normals-by-inverse" => &["normals-by-inverse"],
        "normals-as-points" => &["normals-as-points"],
        "normals-in-eye-space" => &["normals-in-view-space"],
        "viewport-less-one" => &["viewport-less-one"],
        "corners-on-whole-pixels" => &["corners-on-whole-pixels"],
        "mirrored-winding" => &["mirrored-inside"],
        "depth-of-triangle" => &["depth-of-polygons"],
        "depth-ties-to-last" => &["depth-ties-to-last"],
        "triangles-strip" => &["triangle-strip"],
        "rounding-256" => &["times-256-wrapped", "times-256"],
        "overflow-by-largest-channel" => &["divided-by-largest"],
        "overflow-tone-mapped" => &["tone-mapped"],
        "layout-columns" => &["columns-as-rows"],
        "half-height-as-height" => &["fov-halved"],
        "aspect-missing" => &["aspect-missing"],
        "aspect-inverted" => &["aspect-inverted"],
        "upside-down" => &["upside-down"],
        // In a mirrored picture, it is off the other way.
        "half-pixel" => &[
            "half-pixel-off",
            "half-pixel-off-back",
            "half-pixel-off-flipped",
            "half-pixel-off-flipped-back",
        ],
        "culling-reversed" => &["cull-front"],
        "culling-missing" => &["cull-none"],
        "depth-reversed" => &["depth-reversed"],
        "depth-missing" => &["depth-missing"],
        "triangles-fan" => &["fan-of-concave"],
        "triangles-first-three" => &["first-triangle"],
        "encoding-linear" => &["not-encoded"],
        "encoding-srgb" => &["encoded-srgb"],
        "encoding-gamma-2.2" => &["power-2.2"],
        "encoding-twice" => &["encoded-twice"],
        "encoding-decoded" => &["power-2.2-backward", "decoded"],
        "rounding-down" => &["truncated"],
        "overflow-wraps" => &["wrapped"],
        "overflow-normalised" => &["stretched"],
        "channels-bgr" => &["bgr"],
        "channels-grey" => &["grey", "grey-levels"],
        "layout-right-to-left" => &["mirrored-x"],
        "layout-half-turn" => &["turned"],
        "layout-one-row-down" => &["pixel-off-down"],
        "light-by-inverse-rotation" => &["lights-by-inverse-rotation"],
        "light-moved-to-eye-space" => &["lights-moved-to-view-space"],
        "light-xy-exchanged" => &["light-xy-exchanged"],
        "light-xz-exchanged" => &["light-xz-exchanged"],
        "points-in-eye-space" => &["positions-in-view-space"],
        "diffuse-wrapped" => &["diffuse-wrapped"],
        "diffuse-squared" => &["diffuse-squared"],
        "diffuse-of-angle" => &["diffuse-of-angle"],
        "diffuse-in-steps" => &["diffuse-in-steps"],
        "diffuse-without-shine" => &["diffuse-times-rest"],
        "terms-mixed-with-light" => &["mixed-not-added"],
        "terms-ambient-as-least" => &["ambient-as-floor"],
        "terms-larger" => &["diffuse-or-highlight"],
        "specular-energy-of-lobe" => &["highlight-normalised"],
        "specular-hue-of-kd" => &["highlight-tinted"],
        "specular-fresnel" => &["highlight-fresnel"],
        "reflection-bracketed" | "reflection-bracketed-unit" => &["reflection-times-cosine"],
        "half-vector-of-distances" => &["halfway-of-unnormalised"],
        "half-vector-constant" => &["halfway-constant"],
        "view-of-two-spaces" => &["view-of-two-spaces"],
        "view-of-unit-vectors" => &["view-of-unit-vectors"],
        "view-at-vertices" => &["view-per-vertex"],
        "normals-are-positions" => &["normals-are-positions"],
        "normals-of-vertex-before" => &["normals-of-vertex-before"],
        "normals-of-vertex-after" => &["normals-of-vertex-after"],
        "normals-x-negated" => &["normals-x-negated"],
        "normals-y-negated" => &["normals-y-negated"],
        "normals-z-negated" => &["normals-z-negated"],
        "normals-xy-exchanged" => &["normals-xy-exchanged"],
        "normals-xz-exchanged" => &["normals-xz-exchanged"],
        "normals-yz-exchanged" => &["normals-yz-exchanged"],
        "normals-halved" => &["normals-not-decoded"],
        "normals-with-w-of-target" => &["w-in-normals"],
        "normals-with-w-of-eye" => &["w-of-eye-in-normals"],
        "corners-on-whole-pixels-tested-there" => &["corners-rounded-and-sampled-there"],
        "corners-cut" => &["corners-cut"],
        "corners-cut-tested-there" => &["corners-cut-and-sampled-there"],
        "channels-grb" => &["red-green-exchanged"],
        "channels-rbg" => &["green-blue-exchanged"],
        "layout-one-right-and-up" => &["pixel-off-right-up"],
        "layout-one-left-and-down" => &["pixel-off-left-down"],
        _ => &[],
    }
}

/// Asks `diagnose` about a picture.
pub fn diagnosed(scene: &Scene, picture: &Picture) -> Diagnosis {
    let pixels = picture.pixels.clone();
    let stored = picture::Picture::from_pixels(picture.width, picture.height, pixels);
    let picture = FilePicture::stored(stored.expect("a whole picture"));
    let question = Question {
        scene,
        method: None,
        picture: &picture,
        at: None,
        light_lengths: &[],
    };
    diagnose(&question, &mut |_| {}).expect("a scene that can be drawn")
}

/// True if the diagnosis contains one of `names`, also among other causes that explain the picture
/// equally well.
fn is_named(found: &Diagnosis, names: &[&str]) -> bool {
    let made = found.causes.iter().flat_map(|cause| &cause.mistakes);
    let is_amount = found.verdict == Verdict::Amounts;
    made.into_iter()
        .any(|mistake| names.contains(&&*mistake.id))
        || is_amount && names.contains(&"amounts")
}

/// Writes the mistakes that a diagnosis names.
pub fn said(found: &Diagnosis) -> String {
    let causes: Vec<String> = found
        .causes
        .iter()
        .take(4)
        .map(|cause| {
            let ids: Vec<&str> = cause.mistakes.iter().map(|mistake| &*mistake.id).collect();
            format!("{} ({:.2})", ids.join(" + "), cause.residual)
        })
        .collect();
    let nearest: Vec<String> = found
        .singles
        .iter()
        .take(2)
        .map(|single| format!("{} {:.2}", single.mistakes[0].id, single.residual))
        .collect();
    let (verdict, before) = (found.verdict, found.reference.levels);
    format!(
        "{verdict:?} {before:.2}: {}; nearest {}",
        causes.join(" or "),
        nearest.join(", ")
    )
}

/// The counts for one kind of picture.
#[derive(Default)]
struct Count {
    named: usize,
    all: usize,
}

impl Count {
    fn add(&mut self, is_named: bool) {
        self.all += 1;
        self.named += usize::from(is_named);
    }
}

/// The results of all scenes: the counts for each kind of picture, and a line for each picture
/// whose mistake was not named.
#[derive(Default)]
struct Found {
    counts: BTreeMap<&'static str, Count>,
    lines: Vec<String>,
}

impl Found {
    fn add(&mut self, kind: &'static str, is_right: bool, line: impl FnOnce() -> String) {
        self.counts.entry(kind).or_default().add(is_right);
        if !is_right {
            self.lines.push(format!("{kind}: {}", line()));
        }
    }

    fn merge(&mut self, other: Found) {
        for (kind, count) in other.counts {
            let all = self.counts.entry(kind).or_default();
            all.named += count.named;
            all.all += count.all;
        }
        self.lines.extend(other.lines);
    }
}

const DIRTY: Variation = Variation {
    dirty: true,
    filling: Filling::OtherTriangles,
    edges: Edges::Moved,
    supersampled: false,
    opaque: false,
};

/// How many pairs of mistakes are tried in each scene, out of some thousand.
const PAIRS: u64 = 120;

/// Random numbers that are equal in each run.
pub struct Random(pub u64);

impl Random {
    /// Returns a number from 0 to less than `most`.
    pub fn below(&mut self, most: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % most
    }
}

/// Tries one in `share` of the pictures of a scene.
fn look(name: &'static str, scene: &Scene, share: u64) -> Found {
    let mut found = Found::default();
    let mut random = Random(name.bytes().fold(7, |seed: u64, byte| {
        seed.wrapping_mul(31).wrapping_add(byte.into())
    }));
    let right = draw(scene, &[], &Variation::default());
    for variation in RIGHT {
        if random.below(share) == 0 {
            let diagnosis = diagnosed(scene, &draw(scene, &[], &variation));
            let is_right = diagnosis.verdict == Verdict::Correct;
            found.add("right", is_right, || {
                format!("{name} {variation:?}: {}", said(&diagnosis))
            });
        }
    }
    // Colours with alpha 0 do not count, so these pictures do not show a wrong background.
    for mistake in MISTAKES
        .iter()
        .filter(|mistake| mistake.step != "background")
    {
        for (kind, variation) in [("clean", Variation::default()), ("dirty", DIRTY)] {
            if random.below(share) == 0 {
                let is_shown = draw(scene, &[mistake], &Variation::default()) != right;
                let picture = draw(scene, &[mistake], &variation);
                if is_shown {
                    single(&mut found, kind, name, mistake, &diagnosed(scene, &picture));
                }
            }
        }
    }
    for _ in 0..PAIRS.div_ceil(share) {
        let mut one = || &MISTAKES[random.below(MISTAKES.len() as u64) as usize];
        let (first, second) = (one(), one());
        let known = [first, second]
            .iter()
            .all(|mistake| !names(mistake.id).is_empty());
        if known && can_be_combined(first, second) && both_are_far(scene, first, second) {
            pair(&mut found, name, scene, [first, second]);
        }
    }
    found
}

/// True if each of two mistakes changes the picture of the other by more than a few levels at many
/// pixels.
fn both_are_far(scene: &Scene, first: &Mistake, second: &Mistake) -> bool {
    let draw = |mistakes: &[&Mistake]| draw(scene, mistakes, &Variation::default());
    let both = draw(&[first, second]);
    [draw(&[first]), draw(&[second]), draw(&[])]
        .iter()
        .all(|other| far(&both, other))
}

/// True if two pictures are so far apart that noise of one level cannot hide the difference.
fn far(a: &Picture, b: &Picture) -> bool {
    let differ = |(a, b): &(&[u8; 4], &[u8; 4])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2);
    a.pixels.iter().zip(&b.pixels).filter(differ).count() > 400
}

fn single(
    found: &mut Found,
    kind: &'static str,
    name: &str,
    mistake: &Mistake,
    diagnosis: &Diagnosis,
) {
    let (names, is_correct) = (names(mistake.id), diagnosis.verdict == Verdict::Correct);
    let seen = match kind {
        "clean" => diagnosis.reference.levels > 0.02,
        _ => diagnosis.reference.beyond > 0.05,
    };
    let line = || format!("{name} {}: {}", mistake.id, said(diagnosis));
    if !seen {
        // This picture does not show the mistake, or noise hides it.
        found.add(
            "unseen, said to be correct",
            is_correct || is_named(diagnosis, names),
            line,
        );
    } else if names.is_empty() {
        let is_told = !matches!(diagnosis.verdict, Verdict::One);
        found.add("not in the table, and no other named", is_told, line);
    } else {
        found.add(kind, is_named(diagnosis, names), line);
    }
}

fn pair(found: &mut Found, name: &str, scene: &Scene, pair: [&Mistake; 2]) {
    let picture = draw(scene, &pair, &Variation::default());
    let diagnosis = diagnosed(scene, &picture);
    let is_right = pair
        .iter()
        .all(|mistake| is_named(&diagnosis, names(mistake.id)));
    let [a, b] = pair.map(|mistake| mistake.id);
    found.add("pair", is_right, || {
        format!("{name} {a} + {b}: {}", said(&diagnosis))
    });
}

/// Variations that are not mistakes.
const RIGHT: [Variation; 6] = {
    let plain = Variation {
        dirty: false,
        filling: Filling::Triangles,
        edges: Edges::TopLeft,
        supersampled: false,
        opaque: false,
    };
    [
        plain,
        DIRTY,
        Variation {
            filling: Filling::ScanLines,
            ..plain
        },
        Variation {
            supersampled: true,
            ..plain
        },
        Variation {
            supersampled: true,
            opaque: true,
            edges: Edges::BottomRight,
            ..plain
        },
        Variation {
            dirty: true,
            ..plain
        },
    ]
};

/// The smallest share of pictures whose mistakes must be named: for all pictures, and for a sample,
/// which is too small for an exact share.
const LEAST: [(&str, f64, f64); 5] = [
    ("clean", 0.95, 0.8),
    ("dirty", 0.9, 0.8),
    ("pair", 0.8, 0.6),
    ("right", 0.95, 0.8),
    ("unseen, said to be correct", 0.95, 0.8),
];

#[test]
fn mistakes_are_named() {
    let share = std::env::var("FASTPHONG_MISTAKES").map_or(200, |share| {
        share.parse().expect("one of how many pictures")
    });
    let is_sample = share > 10;
    let mut all = scenes(320, 240);
    all.retain(|(name, _)| !is_sample || *name != "knot-100k");
    let scenes = Mutex::new(all);
    let found = Mutex::new(Found::default());
    let work = || {
        while let Some((name, scene)) = { scenes.lock().unwrap().pop() } {
            let seen = look(name, &scene, share);
            found.lock().unwrap().merge(seen);
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, |count| count.get()) {
            scope.spawn(work);
        }
    });
    let found = found.into_inner().unwrap();
    found.lines.iter().for_each(|line| println!("{line}"));
    for (kind, Count { named, all }) in &found.counts {
        println!(
            "{kind}: {named} of {all}, {:.1} %",
            100.0 * *named as f64 / *all as f64
        );
    }
    for (kind, least, least_of_sample) in LEAST {
        let least = if is_sample { least_of_sample } else { least };
        let Some(Count { named, all }) = found.counts.get(kind) else {
            assert!(is_sample, "no picture is {kind}");
            continue;
        };
        assert!(
            *named as f64 >= least * *all as f64,
            "{kind}: {named} of {all}"
        );
    }
}
