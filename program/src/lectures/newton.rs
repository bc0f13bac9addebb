//! Newton's method along a span: its error after one, two or three steps per pixel, and where it
//! breaks down (L21 4.2).

use super::prelude::*;
use fastphong::shading::walks::{Newton, NewtonSteps};

pub(super) static FIGURE: Figure = Figure {
    name: "newton",
    title: "Newton\u{2019}s method from pixel to pixel: steps, angles, and where it breaks down",
    lecture: "L21 4.2: \"after only a few iterations\"",
    parts: &[curves, limits, opposed],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "\u{201c}After only a few iterations\u{201d} x − (x² − d²) / 2x reaches d = √(N · N), if x starts at the d of the previous pixel (L21 4.2).",
    handles: &[
        Handle::slider(["angle", "angle of the span", "°"], [5.0, 175.0], 5.0, 60.0),
        Handle::slider(["steps", "steps per pixel", ""], [1.0, 3.0], 1.0, 1.0),
    ],
    make: |content, values| {
        content.plot(along_a_span(values[0]));
        few_iterations(content, values[0], values[1] as u32);
        Ok(())
    },
};

/// How many pixels the span has.
const PIXELS: usize = 16;
/// Steps of Newton's method per pixel.
const STEPS: [u32; 3] = [1, 2, 3];
/// Half a grey level of 255: rounding the picture hides a smaller error.
const INVISIBLE: f64 = 0.5 / 255.0;

/// Returns the relative errors of d along a span of [`PIXELS`] pixels whose end normals are
/// `degrees` apart. It compares the method's own walk with the root in `f64`.
fn errors(degrees: f64, steps: u32) -> Vec<f64> {
    let [from, to] = ends(degrees);
    let step = (to - from) / PIXELS as f64;
    let first = from + 0.5 * step;
    let [start, change] = [first, step].map(|v| vec3(v.as_vec3().to_array()));
    let rule = NewtonSteps::new(steps, NewtonSteps::LARGEST_ERROR);
    let mut walk = Newton::new(start, change, &rule);
    let exact = |k: usize| (first + k as f64 * step).length();
    (0..PIXELS)
        .map(|k| f64::from(walk.next().0) / exact(k) - 1.0)
        .collect()
}

fn largest_error(degrees: f64, steps: u32) -> f64 {
    largest(errors(degrees, steps).into_iter().map(f64::abs))
}

fn angles() -> impl DoubleEndedIterator<Item = f64> {
    (1..=35).map(|i| 5.0 * f64::from(i))
}

fn plural(steps: u32) -> String {
    format!("{steps} step{}", if steps == 1 { "" } else { "s" })
}

fn curves(content: &mut FigureContent) -> Result {
    content.text(format!(
        "A fixed number of steps x − (x² − d²) / 2x follows d = √(N · N) from pixel to pixel. Each pixel \
         starts from the previous pixel's d; the first one computes a true root. The method's own walk \
         in f32, along spans of {PIXELS} pixels, is compared with the root in f64.",
    ));
    let over_angles = |steps| Series::sampled(plural(steps), angles(), |d| largest_error(d, steps));
    content.plot(Plot::new(
        "Largest relative error of d, by the angle of a span",
        [linear("angle of the span, degrees"), log("relative error")],
        STEPS.map(over_angles),
        "Each step squares the error and halves it, until only rounding is left (about 10⁻⁷).",
    ));
    content.plot(along_a_span(150.0));
    Ok(())
}

/// Plots the error at each pixel of a span.
fn along_a_span(degrees: f64) -> Plot {
    let curve = |steps| {
        let errors = errors(degrees, steps).into_iter().enumerate();
        let points = errors.map(|(k, error)| (k as f64, error.abs().max(1e-8)));
        Series::new(plural(steps), points)
    };
    Plot::new(
        "Relative error of d along a span",
        [linear("pixel"), log("relative error of d")],
        STEPS.map(curve),
        format!(
            "A span of {degrees}°. The error follows the change of d, which vanishes in the middle, where \
             d is smallest. Errors below 10⁻⁸ are drawn at 10⁻⁸."
        ),
    )
}

/// Adds the finding that `steps` steps are or are not enough on a span of `degrees`.
fn few_iterations(content: &mut FigureContent, degrees: f64, steps: u32) {
    let (name, error) = (plural(steps), largest_error(degrees, steps));
    let is_enough = error < INVISIBLE;
    content.found(
        &format!("error-{steps} | span of {degrees}°, {name}: largest relative error of d"),
        (error, "", true),
        Agreement::if_holds(is_enough),
        if is_enough {
            "A few iterations are enough: rounding to grey levels hides the error."
        } else {
            "Too few for normals this far apart: the error is half a grey level or more."
        },
    );
}

/// Measures the errors of one, two and three steps, and the largest angle without a visible error.
fn limits(content: &mut FigureContent) -> Result {
    let first = largest(STEPS.map(|steps| errors(150.0, steps)[0].abs()));
    content.adds(
        "first-pixel | first pixel of a span: relative error of d",
        (first, "", first < 2e-7),
        "It is a true root, rounded.",
    );
    for steps in STEPS {
        few_iterations(content, 60.0, steps);
    }
    // If the previous pixel's d is off by e, one step leaves e² / (2 (1 + e)). Compute e from the
    // walk's own previous pixel.
    let walked = errors(60.0, 1);
    let (sin, cos) = libm::sincos(30.0_f64.to_radians());
    let length = |k: usize| {
        let t = (k as f64 + 0.5) / PIXELS as f64;
        libm::hypot(sin * (2.0 * t - 1.0), cos)
    };
    let off = largest(walked.windows(2).enumerate().map(|(k, pair)| {
        let e = (1.0 + pair[0]) * length(k) / length(k + 1) - 1.0;
        (pair[1] - e * e / (2.0 * (1.0 + e))).abs()
    }));
    content.adds(
        "theory | span of 60°, 1 step: largest difference of the error from e² / (2 (1 + e))",
        (off, "", off < 1e-6),
        "Apart from rounding, the error is what theory predicts.",
    );
    for steps in STEPS {
        let name = plural(steps);
        let is_good = |degrees: &f64| largest_error(*degrees, steps) < INVISIBLE;
        let degrees = angles().take_while(is_good).last().unwrap_or(0.0);
        let each = written(degrees / PIXELS as f64);
        content.adds(
            &format!(
                "limit-{steps} | {name}: largest angle of a span of {PIXELS} pixels without a visible error"
            ),
            (degrees, "degrees", true),
            &format!(
                "That is {each}° per pixel. Angles were tried in steps of 5°; half a grey level counts as visible."
            ),
        );
    }
    Ok(())
}

/// Draws normals that nearly cancel: their length falls to almost nothing and grows again within
/// one or two pixels.
fn opposed(content: &mut FigureContent) -> Result {
    const DEGREES: f64 = 179.9;
    let strip = ScreenPolygon::strip([0.0, 31.0], 6.0, ends(DEGREES));
    let frame = frame([31, 6], DULL, DVec3::new(1.0, 0.0, 0.6), &[strip])?;
    let naive = draw(&frame, "naive-phong")?;
    content.text(format!(
        "The normals at the ends are almost opposite ({DEGREES}°, over 31 pixels), so d falls to almost \
         nothing in the middle and grows again. There a step starts from far too small a guess and \
         overshoots to about d² / 2x. The span stays dark until the steps have come down."
    ));
    let mut panels = vec![(String::from("naive Phong"), stored(&naive))];
    let mut not_finite = 0;
    for steps in STEPS {
        let fast = draw(&frame, &format!("fast-phong:steps={steps}"))?;
        let pixels = fast.pixels().iter();
        not_finite += pixels.filter(|pixel| !pixel[0].is_finite()).count();
        let worst = levels(&fast, &naive);
        let name = plural(steps);
        content.contradicts(
            &format!(
                "opposed-{steps} | normals {DEGREES}° apart, {name}: largest difference from naive \
                 Phong"
            ),
            (worst, "grey levels", worst > 1.0),
            "A few iterations are not enough where normals nearly cancel.",
        );
        panels.push((format!("fast Phong, {name}"), stored(&fast)));
    }
    content.pictures(2, "Almost opposite normals", panels);
    content.adds(
        "not-finite | pixels of these pictures that are infinite or not a number",
        (not_finite as f64, "pixels", not_finite == 0),
        "The pictures are wrong, but every pixel is a number.",
    );
    Ok(())
}
