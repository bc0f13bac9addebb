//! The exercises of Lecture 21: a table of sines read between its lines, and e^t by one multiplication a pixel.

use super::stage::{Corner, Facet, Grey, frame, stored, written};
use super::{Content, Figure, FigureError, Plot, Scale, Series, Shown};
use crate::number::{Counter, Num};
use crate::picture::LinearPicture;
use crate::raster::depth;
use crate::shading::{Variant, Walk};
use alloc::format;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "exercises",
    title: "The exercises: a table of sines, and e to the t by one multiplication a pixel",
    lecture: "L21, Exercises 1 and 2",
    make,
};

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    sine(&mut content)?;
    exponential(&mut content);
    fog(&mut content)?;
    Ok(content)
}

/// The two lines of the table in Exercise 1: degrees, and the sine in five decimals.
const TABLE: [(f64, f64); 2] = [(24.0, 0.40674), (25.0, 0.42262)];

/// Exercise 1: Gouraud shading is a machine that reads between the lines of a table.
fn sine(content: &mut Content) -> Result<(), FigureError> {
    // From the centre of pixel 0 to that of pixel 10: pixel 3 is 0.3 of the way. L · N is the normal's z.
    let normal = |z: f64| DVec3::new(libm::sqrt(1.0 - z * z), 0.0, z);
    let [(_, low), (_, high)] = TABLE;
    let at = |place, z| Corner::new(place, normal(z));
    let strip = [
        at([0.5, 0.0], low),
        at([10.5, 0.0], high),
        at([10.5, 4.0], high),
        at([0.5, 4.0], low),
    ];
    let picture = Variant::parse("gouraud")?.render_linear(&frame(
        [11, 4],
        &Grey::dull(DVec3::Z),
        &[Facet::new(strip)],
    )?);
    let found = f64::from(picture.get(3, 1)[0]);
    let truth = libm::sin(24.3_f64.to_radians());
    content.text(format!(
        "Exercise 1. A span of ten pixels from {low} (sin 24°) to {high} (sin 25°), shaded by Gouraud's method, holds \
         {found:.6} at its fourth pixel, 0.3 of the way: the sine of 24.3° is {truth:.6}. Linear interpolation is off by \
         {}; half a unit of the table's last decimal is {}.",
        written(truth - found),
        written(0.5e-5)
    ));
    let is_within = (found - truth).abs() < 1.5e-5;
    content.claim(
        "sine",
        "sin 24.3° by linear interpolation",
        (found, ""),
        is_within,
        [
            "The estimate is as good as the table that it is read from.",
            "The estimate is worse than the table that it is read from.",
        ],
    );
    content.adds(
        "sine-error",
        "its distance from the sine",
        (truth - found, ""),
        "A chord lies below the sine, and the table is rounded.",
    );
    Ok(())
}

/// e^{kt} along a span: `e^{t + Δt} = e^t · e^{Δt}` (L21, Exercise 2).
#[derive(Clone, Copy, Debug)]
struct Exponential<F> {
    at: F,
    factor: F,
}

impl Exponential<f32> {
    /// Starts at `exp(start)` and goes on to `exp(start + step)`.
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

/// Exercise 2: what a step costs, and how far it drifts.
fn exponential(content: &mut Content) {
    let counter = Counter::default();
    let mut counted = Exponential {
        at: counter.number(1.0),
        factor: counter.number(0.5),
    };
    counted.next();
    let counts = counter.take();
    let others = counts.additions + counts.divisions + counts.powers + counts.trigonometric;
    let is_one = counts.multiplications == 1 && others == 0;
    content.claim(
        "multiplications",
        "operations a pixel of e to the t",
        (f64::from(counts.multiplications + others), ""),
        is_one,
        [
            "One multiplication and nothing else, counted.",
            "More than one multiplication, counted.",
        ],
    );

    const PIXELS: usize = 1024;
    let mut largest: f64 = 0.0;
    let curves = [0.25, 1.0, 4.0].map(|fall: f64| {
        let step = -fall / PIXELS as f64;
        let mut walk = Exponential::new(0.0, step);
        let errors: Vec<f64> = (0..PIXELS)
            .map(|k| {
                let exact = libm::exp(step * k as f64);
                (f64::from(walk.next()) / exact - 1.0).abs()
            })
            .collect();
        largest = errors.iter().copied().fold(largest, f64::max);
        Series::new(
            format!("from 1 to e^−{fall}"),
            (8..PIXELS).step_by(8).map(|k| (k as f64, errors[k])),
        )
    });
    // Each of the products is rounded once, and the factor, rounded once, is in each of them.
    let bound = 2.0 * (PIXELS - 1) as f64 / (1 << 24) as f64;
    content.plot(Plot {
        title: "Exponential by one multiplication a pixel: relative error over a span".into(),
        x: ("pixel".into(), Scale::Linear),
        y: ("relative error".into(), Scale::Log),
        series: curves.into(),
        marks: Vec::new(),
        caption: format!(
            "In f32, over {PIXELS} pixels. Two roundings of 2⁻²⁴ a pixel (of the product, and of the factor that is in \
             each) allow {} at the end; {} was the largest.",
            written(bound),
            written(largest)
        ),
    });
    let holds = largest <= bound;
    content.claim(
        "drift",
        "largest relative error over 1024 pixels",
        (largest, ""),
        holds,
        [
            "Within two roundings a pixel: far below a grey level.",
            "More than two roundings a pixel explain.",
        ],
    );
}

/// What is seen of a surface at depth 0 is left by fog in this part at depth 1: e^-`DENSITY`.
const DENSITY: f64 = 2.5;

/// Exponential fog over a tilted plane: depth is linear on the screen, so that the exponential can be stepped.
fn fog(content: &mut Content) -> Result<(), FigureError> {
    // A plane: depth is a linear function of the place.
    let at = |x: f64, y: f64| Corner {
        place: [x, y],
        depth: 0.45 * x / 240.0 + 0.55 * (1.0 - y / 132.0),
        normal: DVec3::Z,
    };
    let plane = [
        at(20.0, 8.0),
        at(232.0, 24.0),
        at(220.0, 124.0),
        at(6.0, 110.0),
    ];
    let grey = Grey {
        diffuse: 0.15,
        ..Grey::dull(DVec3::Z)
    };
    let frame = frame([240, 132], &grey, &[Facet::new(plane)])?;
    let surface = Variant::parse("flat")?.render_linear(&frame);
    let depth = depth(&frame);
    let (mut stepped, mut exact) = (surface.clone(), surface.clone());
    let mut largest: f64 = 0.0;
    for y in 0..surface.height() {
        let covered = |x: &usize| depth.get(*x, y).is_finite();
        let Some(start) = (0..surface.width()).find(covered) else {
            continue;
        };
        let count = (start..surface.width()).take_while(covered).count();
        let first = f64::from(depth.get(start, y));
        let last = f64::from(depth.get(start + count - 1, y));
        let step = (last - first) / (count - 1).max(1) as f64;
        let mut walk = Exponential::new(-DENSITY * first, -DENSITY * step);
        for x in start..start + count {
            let (left, truth) = (
                walk.next(),
                libm::exp(-DENSITY * f64::from(depth.get(x, y))),
            );
            mix(&mut stepped, x, y, left);
            mix(&mut exact, x, y, truth as f32);
            largest = largest.max((f64::from(left) - truth).abs());
        }
    }
    let levels = 255.0 * largest;
    let shown = |caption: &str, picture: &LinearPicture| {
        Shown::new(
            caption,
            format!("A tilted plane that fades into white fog, {caption}."),
            stored(picture),
        )
    };
    content.text(format!(
        "Exercise 2 at work: a dark plane, tilted against the screen, in exponential fog. Under an orthographic camera \
         depth is linear on the screen, so that one multiplication a pixel gives the fog of each pixel exactly, rounding \
         aside. The two pictures differ by at most {} grey levels.",
        written(levels)
    ));
    content.pictures(
        2,
        [
            shown("one multiplication a pixel", &stepped),
            shown("one exponential a pixel", &exact),
        ]
        .into(),
    );
    let holds = levels < 0.5;
    content.claim(
        "fog",
        "largest difference of the fog by steps from that by exponentials",
        (levels, "grey levels"),
        holds,
        [
            "The pictures cannot be told apart.",
            "The pictures can be told apart.",
        ],
    );
    Ok(())
}

/// Lets through the part `left` of what is seen, and adds white fog for the rest.
fn mix(picture: &mut LinearPicture, x: usize, y: usize, left: f32) {
    let texel = &mut picture.row_mut(y)[x];
    for channel in &mut texel[..3] {
        *channel = *channel * left + (1.0 - left);
    }
}
