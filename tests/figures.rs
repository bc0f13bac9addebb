//! The lecture's figures, made anew: each is made, and what a claim of the lecture rests on is what theory says.
#![cfg(feature = "cli")]

use fastphong::figures::{Agreement, Block, Content, FIGURES, Figure};
use fastphong::report::{LectureFigure, figures_page};
use std::collections::BTreeSet;

/// A figure, made, with what every figure must have.
#[track_caller]
fn made(name: &str) -> Content {
    let figure = Figure::find(name).expect("it stands in the table");
    let content = figure.make().expect("what it draws can be drawn");
    assert!(!content.blocks.is_empty() && !content.findings.is_empty(), "{name} shows nothing");
    let mut keys = BTreeSet::new();
    for finding in &content.findings {
        assert!(finding.value.is_finite(), "{name}, {}: {}", finding.key, finding.value);
        assert!(keys.insert(&finding.key), "{name} has two findings called {}", finding.key);
        assert!(finding.verdict.ends_with('.') && !finding.label.is_empty(), "{name}, {}: no sentence", finding.key);
    }
    for block in &content.blocks {
        match block {
            Block::Text(text) => assert!(!text.is_empty()),
            Block::Pictures { shown, .. } => assert!(shown.iter().all(|s| !s.alt.is_empty() && !s.caption.is_empty())),
            Block::Plot(plot) => {
                assert!((1..=6).contains(&plot.series.len()), "{name}, {}: curves that look alike", plot.title);
                assert!(plot.series.iter().all(|s| s.points.len() > 1), "{name}, {}: an empty curve", plot.title);
            }
            Block::Table { head, rows } => assert!(rows.iter().all(|row| row.len() == head.len()), "{name}"),
        }
    }
    let drawn = LectureFigure::new(figure, content.clone()).expect("its pictures can be written");
    let page = figures_page(&[drawn], &["fastphong".into()]);
    assert!(page.len() < 200_000, "{name} takes {} bytes of a page", page.len());
    content
}

/// The value of a finding.
#[track_caller]
fn value(content: &Content, key: &str) -> f64 {
    content.finding(key).unwrap_or_else(|| panic!("no finding {key}")).value
}

#[track_caller]
fn agreement(content: &Content, key: &str) -> Agreement {
    content.finding(key).unwrap_or_else(|| panic!("no finding {key}")).agreement
}

#[test]
fn every_figure_has_a_name_and_a_test_of_its_own() {
    let source = include_str!("figures.rs");
    let mut names = BTreeSet::new();
    for figure in FIGURES {
        assert!(names.insert(figure.name), "two figures are called {}", figure.name);
        assert!(figure.name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'));
        assert!(source.contains(&format!("made(\"{}\")", figure.name)), "no test makes {}", figure.name);
    }
    assert!(Figure::find("exercise").unwrap_err().contains("did you mean `exercises`?"));
}

#[test]
fn exercises() {
    let content = made("exercises");
    // 0.40674 + 0.3 (0.42262 − 0.40674) = 0.411504; the engine adds three steps of an f32, each off by 2⁻²⁵ at most, to
    // a start whose normal is off by as much: below 2⁻²².
    let f32_error = 1.0 / f64::from(1 << 22);
    assert!((value(&content, "sine") - 0.411504).abs() < f32_error);
    // The chord of one degree lies below the sine by at most sin 25° (1°)²/8 = 1.6e-5, and the table is off by 5e-6.
    let error = value(&content, "sine-error");
    assert!(error > 0.0 && error < 1.6e-5 + 5e-6, "{error}");
    assert_eq!(value(&content, "multiplications"), 1.0);
    // Two roundings of 2⁻²⁴ a pixel, over 1023 steps; and they do add up: a walk without drift is not a walk in f32.
    let drift = value(&content, "drift");
    assert!(drift > 1e-7 && drift < 2.0 * 1023.0 / f64::from(1 << 24), "{drift}");
    // The same over 230 pixels at most, and depth itself off by as many roundings, times the density 2.5.
    let levels = value(&content, "fog");
    assert!(levels < 255.0 * (2.0 + 2.5) * 230.0 / f64::from(1 << 24), "{levels}");
    for key in ["sine", "multiplications", "drift", "fog"] {
        assert_eq!(agreement(&content, key), Agreement::Confirms, "{key}");
    }
}

#[test]
fn square() {
    let content = made("square");
    for method in ["gouraud", "naive-phong", "fast-phong", "slerp-phong"] {
        // The middle of the square lies on the diagonal between two white corners at 0°, and between a white and the
        // black one at 90°. Half-way, Gouraud's intensity is ½, that of a normal at 45° is √½: the picture changes by half
        // of white, or by 0.29 of it. Both ways to cut differ there in the same way. The pixels beside the diagonal are
        // half a pixel away, which is less than 3 %.
        let least = 255.0 * (if method == "gouraud" { 0.5 } else { 1.0 - 0.5f64.sqrt() } - 0.03);
        for key in [format!("square-{method}"), format!("diagonals-{method}")] {
            assert!((least..160.0).contains(&value(&content, &key)), "{key}: {}", value(&content, &key));
        }
        let triangles = value(&content, &format!("triangles-{method}"));
        match method {
            // T24: great circles are not barycentric.
            "slerp-phong" => assert!(triangles > 1.0, "{triangles}"),
            // Both orientations round an affine function, over 120 rows and 120 pixels: N, J and K are each off by
            // 240 · 2⁻²⁴; a normal is not shorter than its z, 0.4 here, so that the intensity is off by √3 / 0.4 times that
            // in each. Fast Phong adds e²/2 of the second step of Newton's, after a change of d by 2 % at most: 2e-8.
            _ => assert!(triangles < 255.0 * 2.0 * 4.4 * 240.0 / f64::from(1 << 24), "{method}: {triangles}"),
        }
        let expected = if method == "slerp-phong" { Agreement::Contradicts } else { Agreement::Confirms };
        assert_eq!(agreement(&content, &format!("triangles-{method}")), expected);
    }
    assert!(value(&content, "normals-square") > 10.0);
    // As the intensities: 2 · 4.4 · 240 · 2⁻²⁴ = 1.26e-4 of a radian.
    assert!(value(&content, "normals-triangles") < 1.26e-4f64.to_degrees());
}

#[test]
fn mach_bands() {
    let content = made("mach-bands");
    let control = value(&content, "slope-cylinder");
    for method in ["gouraud", "naive-phong", "slerp-phong"] {
        // Common edges have common normals, so that intensities agree; parabolas through pixels bring less than the
        // third derivative, n³/R³ of 255 levels at most for the highlight, over 5³ pixels: 0.15.
        let jump = value(&content, &format!("value-{method}"));
        assert!(jump < 0.15, "{method}: {jump}");
        assert_eq!(agreement(&content, &format!("value-{method}")), Agreement::Confirms);
        // T4: the slope jumps, by far more than what the measurement makes of the smooth cylinder.
        let slope = value(&content, &format!("slope-{method}"));
        assert!(slope > 4.0 * control, "{method}: {slope} against {control}");
        assert_eq!(agreement(&content, &format!("slope-{method}")), Agreement::Contradicts);
    }
    assert!(value(&content, "value-flat") > 10.0, "L21 2: discontinuities along edges");
    // Chords of intensities cut off the highlight, of which interpolated normals keep the shape: theirs bend less.
    assert!(value(&content, "slope-gouraud") > value(&content, "slope-naive-phong"));
}

#[test]
fn duff() {
    let content = made("duff");
    let [gouraud, naive, slerp] = ["gouraud", "naive-phong", "slerp-phong"].map(|key| value(&content, key));
    // φ₁ = 90°, φ₂ = 20°, θ = 40°, two pixels a degree: 255 sin 40° (sin 20°/40 − 1/180) = 0.491. The parabolas through
    // five pixels are off by their third derivative, which is 1e-4 of that over a facet of 40 pixels; 2 % are allowed.
    let expected = 255.0 * 40f64.to_radians().sin() * (20f64.to_radians().sin() / 40.0 - 1.0 / 180.0);
    assert!((value(&content, "closed-form") - expected).abs() < 1e-9);
    assert!((naive - expected).abs() < 0.02 * expected, "{naive} instead of {expected}");
    // Gouraud: 255 ((cos 20° − cos 40°)/40 − cos 40°/180), as the far left corner is dark. Both sides are lines, and
    // parabolas are exact on them; 64 + 240 roundings of 2⁻²⁴ · 255 levels over four pixels are below 0.002.
    let chords =
        255.0 * ((20f64.to_radians().cos() - 40f64.to_radians().cos()) / 40.0 - 40f64.to_radians().cos() / 180.0);
    assert!((gouraud - chords).abs() < 0.002, "{gouraud} instead of {chords}");
    assert!(naive > 10.0 * gouraud.abs(), "Duff's surprise");
    // The circle itself does not bend; the same roundings, and the third derivative of a cosine of two pixels a degree.
    assert!(slerp.abs() < 0.003, "{slerp}");
    assert_eq!(agreement(&content, "naive-phong"), Agreement::Contradicts);
}

#[test]
fn newton() {
    let content = made("newton");
    // The root is rounded once, and N · N by four roundings, which the root halves: 3 · 2⁻²⁴.
    assert!(value(&content, "first-pixel") < 3.0 / f64::from(1 << 24));
    // Over 60°, d changes by less than 1.9 % a pixel (its relative rate is tan 30° · 2 sin 30° / 16 at the ends), plus
    // what is left of the pixel before: e²/2 < 2.4e-4, then e²/2 < 3e-8 and rounding, 5 · 2⁻²⁴.
    let [one, two, three] = [1, 2, 3].map(|steps| value(&content, &format!("error-{steps}")));
    let rounding = 5.0 / f64::from(1 << 24);
    assert!(one > 1e-4 && one < 0.036f64.powi(2) / 2.0, "{one}");
    assert!(two < 2.4e-7 + rounding && three < rounding, "{two} {three}");
    // Rounding of x and of N, over 16 pixels.
    assert!(value(&content, "theory") < 16.0 / f64::from(1 << 24));
    // T26: more steps are better everywhere, and none of one to three is enough near normals that cancel.
    assert!(value(&content, "limit-1") < value(&content, "limit-2"));
    assert!(value(&content, "limit-2") <= value(&content, "limit-3"));
    let [one, two, three] = [1, 2, 3].map(|steps| value(&content, &format!("opposed-{steps}")));
    assert!(one > two && two > three && one > 10.0, "{one} {two} {three}");
    assert_eq!(value(&content, "not-finite"), 0.0);
}

#[test]
fn slerp() {
    let content = made("slerp");
    // A turn is 1.9° a pixel; each normal is off by about 130 roundings of 2⁻²⁴ at most, 8e-6 of 0.033.
    assert!(value(&content, "speed-slerp") < 1.0 + 2.0 * 130.0 / f64::from(1 << 24) / 0.0327);
    // 1/cos² 60° = 4 between the ends and the middle; half a pixel of 64 away from them it is a little less.
    let ratio = value(&content, "speed-linear");
    assert!((3.8..4.0).contains(&ratio), "{ratio}");
    assert_eq!(value(&content, "step"), 12.0);
    assert_eq!(agreement(&content, "step"), Agreement::Confirms);
    // Goldman's rotation: the amplitude drifts by 2⁻²³ a step; two of them, over sin 30°.
    let goldman = value(&content, "drift-goldman");
    assert!(goldman < 4.0 * 1024.0 / f64::from(1 << 23), "{goldman}");
    // Chebyshev's recurrence turns a rounding ε of 2 cos δ into an angle ε / (2 δ) at each step: with ε up to 2⁻²⁴ and
    // δ = 30°/1024 that is 6e-5 a pixel and up to 6e-2 in the end. The difference form keeps α to a relative 2⁻²⁴.
    let [chebyshev, difference] = ["drift-chebyshev", "drift-difference"].map(|key| value(&content, key));
    assert!(chebyshev > 20.0 * goldman && chebyshev < 0.2, "{chebyshev}");
    assert!(difference < goldman, "{difference} {goldman}");
    // T25: in f32 the cosine of 0.02° is 1 or its neighbour, 1 − 2⁻²⁴: the angle is 0 or at least 0.0198° · k.
    assert!(value(&content, "printed-angle") > 0.01);
    // The method itself is within its rounding of the reference: 2⁻²² a step of 64 in the cosines, times n = 20 and 2.
    let ends = value(&content, "ends");
    assert!(ends < 255.0 * 64.0 * 40.0 / f64::from(1 << 22), "{ends}");
}

#[test]
fn fast_vs_naive() {
    let content = made("fast-vs-naive");
    assert!(value(&content, "default") <= 1.0, "the default steps are chosen so that no pixel differs by a level");
    assert!(value(&content, "one-step") > value(&content, "default"));
    assert!(value(&content, "one-step") >= value(&content, "one-step-sphere"));
    // L21 4.1 and 4.2: one root a pixel, and none; (4.2), (3.6): three additions for a normal, one a channel.
    assert_eq!((value(&content, "roots-naive"), value(&content, "roots-fast")), (1.0, 0.0));
    assert_eq!((value(&content, "walk-naive"), value(&content, "walk-gouraud")), (3.0, 3.0));
    // L21 4.4: four additions and eight multiplications, and one and two more for each of J and K.
    assert_eq!(value(&content, "walk-slerp"), 18.0);
    assert_eq!(agreement(&content, "walk-slerp"), Agreement::Confirms);
}

#[test]
fn newell() {
    let content = made("newell");
    // Corners are off by 2⁻²⁵ at most along each axis, over a polygon of radius 1 or more than half of it.
    let bound = (3f64.sqrt() * 4.0 / f64::from(1 << 25)).to_degrees();
    assert!(value(&content, "newell") < bound, "{} over {bound}", value(&content, "newell"));
    assert!(value(&content, "area") < 3f64.sqrt() * 8.0 / f64::from(1 << 25));
    // The cross product of two edges of length 1 is off by a few roundings of 2⁻²⁴.
    assert!(value(&content, "hexagon") < 10.0 * bound);
    // L21 1.1: edges of 1e-6 are 17 units of 2⁻²⁴ long, which turns the normal by degrees; collinear ones have none.
    for key in ["short", "collinear", "nearly"] {
        assert!(value(&content, key) > 1.0, "{key}: {}", value(&content, key));
        assert_eq!(agreement(&content, key), Agreement::Confirms);
    }
    // T17: the sign.
    assert!(value(&content, "reflex") > 179.9);
}

#[test]
fn frequency() {
    let content = made("frequency");
    for end in ["coarsest", "finest"] {
        let [face, vertex, pixel] = ["face", "vertex", "pixel"].map(|f| value(&content, &format!("{f}-{end}")));
        assert!(face > vertex && vertex > pixel, "{end}: {face} {vertex} {pixel}");
    }
    for frequency in ["face", "vertex", "pixel"] {
        let [coarse, fine] = ["coarsest", "finest"].map(|end| value(&content, &format!("{frequency}-{end}")));
        // Sixteen times as many bands: the error of one colour a face is at least in proportion to a face's size.
        assert!(coarse > 8.0 * fine, "{frequency}: {coarse} {fine}");
    }
}

#[test]
fn painter() {
    let content = made("painter");
    for key in ["ring-wrong", "ring-best-order", "cutting-wrong"] {
        assert!(value(&content, key) > 50.0, "{key}: {}", value(&content, key));
    }
    assert_eq!(value(&content, "ring-cycle"), 3.0);
    // Three polygons, each of which meets the two others.
    assert_eq!(value(&content, "cutting-pairs"), 3.0);
    assert_eq!(value(&content, "order"), 0.0, "no two polygons have equal depth at a pixel");
}

#[test]
fn depth() {
    let content = made("depth");
    assert!(value(&content, "fighting-16") > 100.0, "{}", value(&content, "fighting-16"));
    assert_eq!(value(&content, "fighting-24"), 0.0);
    assert_eq!(agreement(&content, "ways"), Agreement::Confirms);
    assert!(value(&content, "ways") > 0.0, "two ways that are one way show nothing");
    // z(2n) in 0..1 is f/(f − n) · (1 − n/2n) = f/(2 (f − n)), and f is 500 n.
    assert!((value(&content, "half") - 0.5 * 500.0 / 499.0).abs() < 1e-12);
    // z(f/2) = f/(f − n) (1 − 2n/f) = 498/499, and half-way is (f/2 − n)/(f − n) = 249/499; twice that in −1..1.
    assert!((value(&content, "preserved") - 2.0 * 249.0 / 499.0).abs() < 1e-12);
}

#[test]
fn supersampling() {
    let content = made("supersampling");
    // One sample gives 0 or 1 for shares that are spread between: an error of √(1/12) = 0.29 at least for evenly spread
    // shares. With n × n the error is that of the edge within a row of samples, below 1/n of it.
    assert!(value(&content, "share") > 8.0, "{}", value(&content, "share"));
    assert_eq!(agreement(&content, "share"), Agreement::Confirms);
    assert_eq!(value(&content, "linear"), 188.0, "the sRGB level of ½");
}

#[test]
fn illumination_adds_its_terms_and_obeys_the_cosine() {
    let content = made("illumination");
    // Each of the four pictures is within the bound of naive Phong shading, some 10⁻⁵ of 1: far below 0.01 levels.
    assert!(value(&content, "sum") < 0.01);
    // The normal of the turned face is rounded to f32 once, its product with the light a few times.
    assert!((value(&content, "cube") - 0.5).abs() < 4.0 * f64::from(f32::EPSILON));
    assert!(value(&content, "cosine") < 4.0 * f64::from(f32::EPSILON) && value(&content, "kd") < 1e-6);
}

#[test]
fn exponents_narrow_the_highlight() {
    let content = made("exponents");
    assert_eq!(agreement(&content, "narrows"), Agreement::Confirms);
    // cos^p is a half at cos⁻¹(2^(−1/p)).
    let half = |p: f64| (0.5f64.powf(1.0 / p)).acos().to_degrees();
    assert!((value(&content, "narrows") - half(1.0) / half(512.0)).abs() < 1e-9);
    // The notes' text and their Figure 7 contradict each other.
    assert_eq!(agreement(&content, "shiny"), Agreement::Contradicts);
    // Light and eye are along z, so that R turns by twice the normal's angle and H stays: a half is left at half(20) / 2 of
    // R·V, and at half(p) of N·H. A pixel is a quarter of a degree wide at the middle, and a line is put through two.
    assert!((value(&content, "half-width") - half(20.0) / 2.0).abs() < 0.05);
    assert!((value(&content, "same-exponent") - 2.0).abs() < 0.02);
    assert!((value(&content, "converted") - 2.0 * half(80.0) / half(20.0)).abs() < 0.01);
    assert_eq!(agreement(&content, "same-exponent"), Agreement::Contradicts);
}

#[test]
fn attenuation_clips_or_blackens_where_theory_says() {
    let content = made("attenuation");
    // h / r³ ≥ 1, r² = h² + ρ², in a disc of π ρ² of 16; half of the pixels on its rim may count as either.
    let (h, pi) = (0.3f64, std::f64::consts::PI);
    let disc = |r: f64| (r * r - h * h, (r * r - h * h).sqrt());
    let rim = |radius: f64| 100.0 * pi * radius * (4.0 / 96.0) / 16.0;
    let (square, radius) = disc(h.cbrt());
    assert!((value(&content, "clipped") - 100.0 * pi * square / 16.0).abs() <= rim(radius));
    assert_eq!(value(&content, "clipped-notes"), 0.0);
    // h³ / r³ < 1/255 outside of a disc.
    let (square, radius) = disc(h * 255.0f64.cbrt());
    assert!((value(&content, "dark") - 100.0 * (1.0 - pi * square / 16.0)).abs() <= rim(radius));
}

#[test]
fn constant_vectors_lose_what_six_products_keep() {
    let content = made("constant-vectors");
    assert!(value(&content, "coarse") > 1.0 && agreement(&content, "coarse") == Agreement::Contradicts);
    // The vectors are off by half of a polygon at most: an error of first order in its size, of which a smooth surface
    // cancels nothing in the mean square.
    let order = value(&content, "order");
    assert!((0.7..1.6).contains(&order), "{order}");
    assert!(value(&content, "duff-naive") < 0.1);
    assert_eq!(value(&content, "additions"), 12.0);
}

#[test]
fn normals_want_the_inverse_transpose() {
    let content = made("inverse-transpose");
    // At 45° of the circle: tan⁻¹ s − tan⁻¹ 1/s, which is the largest.
    let s = 2.5f64;
    let largest = (s.atan() - (1.0 / s).atan()).to_degrees();
    assert!((value(&content, "matrix") - largest).abs() < 1e-9);
    assert!(value(&content, "inverse-transpose") < 1e-6);
    assert!(value(&content, "engine") < value(&content, "picture") / 4.0);
    assert_eq!(agreement(&content, "picture"), Agreement::Confirms);
}

#[test]
fn gates_keep_light_from_behind_out() {
    let content = made("gates");
    assert!(value(&content, "behind") > 1.0 && value(&content, "behind-gated") == 0.0);
    assert_eq!(agreement(&content, "behind"), Agreement::Contradicts);
    // A highlight of up to 0.8 · 255 levels that ends at once, while it is over a tenth of its height.
    assert!(value(&content, "line") > 20.0);
    assert!(value(&content, "clamped") > 1.0);
}

#[test]
fn normals_are_averages_and_shorten_in_between() {
    let content = made("normals");
    assert_eq!(agreement(&content, "averaged"), Agreement::Confirms);
    // Errors of averages are of the first order in a polygon's size at least, and that is halved twice.
    assert!(value(&content, "finer") > 4.0);
    // Around a vertex of a torus polygons lie in pairs, whose errors cancel but for a higher order.
    assert!(value(&content, "regular") < 0.05 * value(&content, "averaged"));
    // 32 steps of 3 half units, and as much from the rounded ends; the root of at least 1/4 doubles it.
    assert!(value(&content, "half-way") < 2.0 * (3.0 * 32.0 + 8.0) / f64::from(1 << 24));
    // Cells of 45° by 30°: in the middle of one at most 1 − cos 22.5° cos 15° is lost, and most of it beside the equator.
    let largest = 100.0 * (1.0 - 22.5f64.to_radians().cos() * 15.0f64.to_radians().cos());
    let darkened = value(&content, "darkened");
    assert!((0.5 * largest..=largest + 0.1).contains(&darkened), "{darkened} of {largest}");
}

#[test]
fn barycentric() {
    let content = made("barycentric");
    // f_ac(b) = −f_ab(c), so that the printed γ is −γ/β, below 0 inside: of 58 · 59 / 2 pixels only the 58 on ab are left.
    assert!((value(&content, "printed-gamma") - 100.0 * (1.0 - 58.0 / 1711.0)).abs() < 1e-9);
    // −γ/β ≤ 1 with β ≤ 1 and α ≤ 1: the triangle of a, b and b − c + a, of which the picture has all, its edges closed.
    assert!((value(&content, "printed-gamma-outside") - 100.0).abs() < 5.0);
    assert_eq!(value(&content, "unsigned-areas"), 100.0);
    for key in ["printed-gamma", "printed-gamma-outside", "unsigned-areas"] {
        assert_eq!(agreement(&content, key), Agreement::Contradicts, "{key}");
    }
    for key in ["area", "distance", "centre"] {
        assert_eq!(agreement(&content, key), Agreement::Confirms, "{key}");
    }
}

#[test]
fn cs171() {
    let content = made("cs171");
    let [phong, gouraud, printed] = ["phong", "gouraud", "printed"].map(|key| value(&content, &format!("peak-{key}")));
    // Cells are 22.5° by 25.7°, and cos 8° to the power of 60 is ½: the highlight is smaller than a cell. Unless its middle
    // is within 2° of a vertex or an edge, where cos 2° to the power of 60 is 0.96, more than 4 % of its 115 levels (½ · 0.9)
    // are lost between vertices: 4.6.
    assert!(gouraud < phong - 4.6 && printed < phong - 4.6, "{phong}, {gouraud}, {printed}");
    // A pixel loses at least what the brightest one does.
    assert!(value(&content, "lost") >= phong - printed);
    assert_eq!(agreement(&content, "peak-gouraud"), Agreement::Confirms);
    assert_eq!(agreement(&content, "lost"), Agreement::Contradicts);
    // In front of the eye the test at pixels is clipping, but for the row on the near plane itself, 96 pixels wide.
    assert!(value(&content, "cube-in-front") <= 96.0);
    assert_eq!(agreement(&content, "cube-in-front"), Agreement::Confirms);
    // T29: behind the eye it loses most of the floor.
    assert!(value(&content, "cube-missing") > 500.0);
    assert!(value(&content, "cube-extra") > 0.0);
    for key in ["cube-missing", "cube-extra"] {
        assert_eq!(agreement(&content, key), Agreement::Contradicts, "{key}");
    }
}

#[test]
fn perspective() {
    let content = made("perspective");
    for key in ["wrong-screen", "wrong-screen-triangles"] {
        // Half-way between the near rim, 2.5 away, and the far one, 10.5 away, β is 10.5 / 13 = 0.81 and the screen has ½: it
        // is off by 2.5 of eight squares. From 0 at a rim to there the error passes ½ to 1½ squares, where most pixels are
        // wrong, on at least a quarter of the way: more than an eighth of all.
        assert!(value(&content, key) > 12.5, "{key}: {}", value(&content, key));
        assert_eq!(agreement(&content, key), Agreement::Confirms, "{key}: the slide asks what is wrong");
    }
    // Corners are snapped to 1/512 pixel, and a square is some pixels long: less than 1 of 100 pixels is that near to a line.
    assert!(value(&content, "wrong-space") < 0.5);
    assert_eq!(agreement(&content, "wrong-space"), Agreement::Confirms);
    // T2: half a pixel from A, where the weight should be nearly 1: 1 − β − β.
    assert!(value(&content, "printed-weight") > 0.9);
    assert_eq!(agreement(&content, "printed-weight"), Agreement::Contradicts);
    // 128 additions of an f32 below 1, for value and weight each, over a weight of ¼ at least: 2 · 4 · 128 · 2⁻²⁵.
    assert!(value(&content, "weight") < 1024.0 / f64::from(1 << 25));
    // T6: (f + n)/(f − n) − 4fn/((f − n)(f + n)) with n = 1, f = 40: (41² − 160)/(39 · 41).
    assert!((value(&content, "depth") - 1521.0 / 1599.0).abs() < 1e-12);
    assert_eq!(agreement(&content, "depth"), Agreement::Contradicts);
}
