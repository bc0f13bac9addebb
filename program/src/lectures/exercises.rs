//! The exercises of Lecture 21: a table of sines read between its lines, and e^t by one
//! multiplication per pixel.

use super::prelude::*;
use fastphong::number::{Counter, Num};
use fastphong::raster::depth;

pub(super) static FIGURE: Figure = Figure {
    name: "exercises",
    title: "The exercises: a table of sines, and e to the t by one multiplication per pixel",
    lecture: "L21, Exercises 1 and 2",
    parts: &[sine, exponential, fog, pixels],
    live: None,
};

/// The sines of 24° and 25° in the table of Exercise 1, in five decimals.
const TABLE: [f64; 2] = [0.40674, 0.42262];

/// Draws the span of Exercise 1. It runs from the centre of pixel 0, which shows the sine of 24°,
/// to the centre of pixel 10, which shows the sine of 25°.
fn span() -> Result<LinearPicture> {
    // The light is along z, so L · N is the normal's z.
    let normals = TABLE.map(|z| DVec3::new(libm::sqrt(1.0 - z * z), 0.0, z));
    let strip = ScreenPolygon::strip([0.5, 10.5], 4.0, normals);
    draw(&frame([11, 4], DULL, DVec3::Z, &[strip])?, "gouraud")
}

/// Answers Exercise 1: Gouraud shading reads between the lines of a table.
fn sine(content: &mut FigureContent) -> Result {
    // Pixel 3 is 0.3 of the way.
    let picture = span()?;
    let found = f64::from(picture.get(3, 1)[0]);
    let truth = libm::sin(24.3_f64.to_radians());
    let [low, high] = TABLE;
    let [error, half] = [truth - found, 0.5e-5].map(written);
    content.text(format!(
        "Exercise 1. Gouraud's method shades a span of ten pixels from {low} (sin 24°) to {high} \
         (sin 25°). Its fourth pixel is 0.3 of the way along and holds {found:.6}; sin 24.3° is \
         {truth:.6}. The error is {error}. Half a unit of the table's last decimal is {half}.",
    ));
    content.confirms(
        "sine | sin 24.3° by linear interpolation",
        (found, "", (found - truth).abs() < 1.5e-5),
        "The estimate is as good as the table that it comes from.",
    );
    content.adds(
        "sine-error | sin 24.3° minus its estimate",
        (truth - found, "", true),
        "A chord lies below the curve of the sine, and the table is rounded.",
    );
    Ok(())
}

/// A walk of the exponential along a span: `e^{t + Δt} = e^t · e^{Δt}` (L21, Exercise 2).
#[derive(Clone, Copy, Debug)]
struct Exponential<F> {
    at: F,
    factor: F,
}

impl Exponential<f32> {
    /// Starts at `exp(start)`; the next pixel has `exp(start + step)`.
    fn new(start: f64, step: f64) -> Self {
        Exponential {
            at: libm::exp(start) as f32,
            factor: libm::exp(step) as f32,
        }
    }
}

impl<F: Num> Walk<F> for Exponential<F> {
    type Pixel = F;

    fn next(&mut self) -> F {
        let here = self.at;
        self.at = here * self.factor;
        here
    }
}

/// Answers Exercise 2: counts the operations of a step, and measures the drift.
fn exponential(content: &mut FigureContent) -> Result {
    let counter = Counter::default();
    let mut counted = Exponential {
        at: counter.counted(1.0),
        factor: counter.counted(0.5),
    };
    counted.next();
    let counts = counter.take();
    let others = counts.additions + counts.divisions + counts.powers + counts.trigonometric;
    let all = counts.multiplications + others;
    content.confirms(
        "multiplications | operations per pixel of e to the t",
        (all, "", all == 1 && counts.multiplications == 1),
        "One multiplication and nothing else, counted.",
    );

    const PIXELS: usize = 1024;
    let errors = [0.25, 1.0, 4.0].map(|fall: f64| {
        let step = -fall / PIXELS as f64;
        let mut walk = Exponential::new(0.0, step);
        let error = |k| (f64::from(walk.next()) / libm::exp(step * k as f64) - 1.0).abs();
        (fall, (0..PIXELS).map(error).collect::<Vec<f64>>())
    });
    let most = largest(errors.iter().flat_map(|(_, errors)| errors.iter().copied()));
    // Each product rounds once. The factor was rounded once, and that error enters every product.
    let bound = 2.0 * (PIXELS - 1) as f64 / (1 << 24) as f64;
    let [allowed, measured] = [bound, most].map(written);
    content.plot(Plot::new(
        "The exponential by one multiplication per pixel: relative error along a span",
        [linear("pixel"), log("relative error")],
        errors.map(|(fall, errors)| {
            let shown = (8..PIXELS).step_by(8).map(|k| (k as f64, errors[k]));
            Series::new(format!("from 1 to e^−{fall}"), shown)
        }),
        format!(
            "In f32, over {PIXELS} pixels. Product and factor each add a rounding of 2⁻²⁴ per pixel, \
             which allows {allowed} at the end. The largest measured error is {measured}."
        ),
    ));
    content.confirms(
        "drift | largest relative error over 1024 pixels",
        (most, "", most <= bound),
        "Within two roundings per pixel: far below a grey level.",
    );
    Ok(())
}

/// How dense the fog is: e^-`DENSITY` of the light from a surface at depth 1 comes through.
const DENSITY: f64 = 2.5;

/// Draws exponential fog over a tilted plane. Its depth is linear on the screen, so one
/// multiplication steps the exponential from pixel to pixel.
fn fog(content: &mut FigureContent) -> Result {
    // The polygon is flat because its depth is a linear function of the position.
    let corner = |[x, y]: [f64; 2]| ScreenCorner {
        depth: 0.45 * x / 240.0 + 0.55 * (1.0 - y / 132.0),
        ..ScreenCorner::new([x, y], DVec3::Z)
    };
    let plane = [[20.0, 8.0], [232.0, 24.0], [220.0, 124.0], [6.0, 110.0]].map(corner);
    let plane = [ScreenPolygon::new(plane)];
    let frame = frame([240, 132], grey(0.0, 0.15, 0.0, 1.0), DVec3::Z, &plane)?;
    let surface = draw(&frame, "flat")?;
    let depth = depth(&frame);
    let (mut stepped, mut exact) = (surface.clone(), surface.clone());
    let mut most: f64 = 0.0;
    for y in 0..surface.height() {
        let covered = |x: &usize| depth.get(*x, y).is_finite();
        let Some(start) = (0..surface.width()).find(covered) else {
            continue;
        };
        let count = (start..surface.width()).take_while(covered).count();
        let at = |x| f64::from(depth.get(x, y));
        let step = (at(start + count - 1) - at(start)) / (count - 1).max(1) as f64;
        let mut walk = Exponential::new(-DENSITY * at(start), -DENSITY * step);
        for x in start..start + count {
            let (left, truth) = (walk.next(), libm::exp(-DENSITY * at(x)));
            mix(&mut stepped, x, y, left);
            mix(&mut exact, x, y, truth as f32);
            most = most.max((f64::from(left) - truth).abs());
        }
    }
    let levels = 255.0 * most;
    content.text(format!(
        "Exercise 2 at work: a dark, tilted plane in exponential fog. Under an orthographic camera \
         depth is linear on the screen, so one multiplication per pixel computes the fog, apart from \
         rounding. The two pictures differ by at most {} grey levels.",
        written(levels)
    ));
    content.row(
        "A tilted plane that fades into white fog",
        "one multiplication per pixel | one exponential per pixel",
        [&stepped, &exact].map(stored),
    );
    content.confirms(
        "fog | fog by steps against fog by exponentials, largest difference",
        (levels, "grey levels", levels < 0.5),
        "Nobody can tell the pictures apart.",
    );
    Ok(())
}

/// Lists the values of both exercises at each pixel, to the last bit: the page grades programs that
/// readers write against this table.
fn pixels(content: &mut FigureContent) -> Result {
    let span = span()?;
    let covered = span.row(1).iter().filter(|pixel| pixel[3] > 0.0);
    let mut walk = Exponential::new(0.0, -0.25);
    let rows = covered.enumerate().map(|(k, pixel)| {
        let (intensity, fall) = (pixel[0], walk.next());
        format!("{k} | {intensity} | {fall}")
    });
    content.text(
        "Both exercises pixel by pixel, in the engine's f32: the span from sin 24° to sin 25°, and e to \
         the t for t = 0, −0.25 and so on.",
    );
    content.table("pixel | intensity | e to the t", rows);
    Ok(())
}

/// Lets the part `left` of a pixel's light through, and adds white fog for the rest.
fn mix(picture: &mut LinearPicture, x: usize, y: usize, left: f32) {
    for channel in &mut picture.row_mut(y)[x][..3] {
        *channel = *channel * left + (1.0 - left);
    }
}
