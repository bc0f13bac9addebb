//! Newton's method along a span: how exact so many steps a pixel are, and where they are not (L21 4.2).

use super::stage::{Corner, Facet, Grey, frame, stored, written};
use super::{Content, Figure, FigureError, Plot, Scale, Series, Shown};
use crate::number::vec3;
use crate::shading::increments::{Newton, NewtonSteps};
use crate::shading::{Variant, Walk};
use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "newton",
    title: "Newton\u{2019}s method from pixel to pixel: steps, angles, and where it breaks",
    lecture: "L21 4.2: \"after only a few iterations\"",
    make,
};

/// Pixels of the span that is walked.
const PIXELS: usize = 16;
/// Steps of Newton's method a pixel.
const STEPS: [u32; 3] = [1, 2, 3];

/// The relative errors of d over a span of [`PIXELS`] pixels whose end normals are `degrees` apart: the walk of the
/// method itself, against the root in `f64`.
fn errors(degrees: f64, steps: u32) -> Vec<f64> {
    let (sin, cos) = libm::sincos(degrees.to_radians() / 2.0);
    let [from, to] = [DVec3::new(-sin, 0.0, cos), DVec3::new(sin, 0.0, cos)];
    let step = (to - from) / PIXELS as f64;
    let first = from + 0.5 * step;
    let rule = NewtonSteps::new(steps, NewtonSteps::LARGEST_ERROR);
    let mut walk = Newton::new(
        vec3(first.as_vec3().to_array()),
        vec3(step.as_vec3().to_array()),
        &rule,
    );
    (0..PIXELS)
        .map(|k| {
            let exact = (first + k as f64 * step).length();
            f64::from(walk.next().0) / exact - 1.0
        })
        .collect()
}

fn largest(errors: &[f64]) -> f64 {
    errors.iter().map(|e| e.abs()).fold(0.0, f64::max)
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.text(format!(
        "d = √(N · N) is followed from pixel to pixel by a fixed number of steps x − (x² − d²) / 2x, starting from the d \
         of the previous pixel; the first pixel of a span has a true root. Shown is the walk of the method itself, in f32, \
         over spans of {PIXELS} pixels, against the root in f64.",
    ));
    over_angles(&mut content);
    along_a_span(&mut content);
    numbers(&mut content);
    opposed(&mut content)?;
    Ok(content)
}

fn over_angles(content: &mut Content) {
    let angles: Vec<f64> = (1..=35).map(|i| 5.0 * f64::from(i)).collect();
    let curve = |steps: u32| {
        let points = angles
            .iter()
            .map(|&degrees| (degrees, largest(&errors(degrees, steps))));
        Series::new(plural(steps), points)
    };
    content.plot(Plot {
        title: "Largest relative error of d over the angle of a span".into(),
        x: (
            "angle between the end normals, degrees".into(),
            Scale::Linear,
        ),
        y: ("relative error of d".into(), Scale::Log),
        series: STEPS.map(curve).into(),
        marks: Vec::new(),
        caption: "Each step squares the error and halves it, until rounding is left (about 10⁻⁷)."
            .to_string(),
    });
}

fn along_a_span(content: &mut Content) {
    const DEGREES: f64 = 150.0;
    let curve = |steps: u32| {
        let errors = errors(DEGREES, steps);
        Series::new(
            plural(steps),
            errors
                .into_iter()
                .enumerate()
                .map(|(k, e)| (k as f64, e.abs().max(1e-8))),
        )
    };
    content.plot(Plot {
        title: "Relative error of d along a span".into(),
        x: ("pixel".into(), Scale::Linear),
        y: ("relative error of d".into(), Scale::Log),
        series: STEPS.map(curve).into(),
        marks: Vec::new(),
        caption: format!(
            "A span of {DEGREES}°. The first pixel has a true root; the error follows the change of d, which vanishes in \
             the middle, where d is smallest. Errors below 10⁻⁸ are drawn there."
        ),
    });
}

fn plural(steps: u32) -> alloc::string::String {
    if steps == 1 {
        "1 step".into()
    } else {
        format!("{steps} steps")
    }
}

fn numbers(content: &mut Content) {
    let first = STEPS
        .map(|steps| errors(150.0, steps)[0].abs())
        .into_iter()
        .fold(0.0, f64::max);
    content.adds(
        "first-pixel",
        "first pixel of a span: relative error of d",
        (first, ""),
        if first < 2e-7 {
            "A true root, rounded."
        } else {
            "Not a true root."
        },
    );
    // Half a grey level of 255 is what rounding the picture hides.
    let invisible = 0.5 / 255.0;
    for steps in STEPS {
        let error = largest(&errors(60.0, steps));
        let is_good = error < invisible;
        content.claim(
            format!("error-{steps}"),
            format!(
                "span of 60°, {}: largest relative error of d",
                plural(steps)
            ),
            (error, ""),
            is_good,
            [
                "Less than rounding to grey levels hides: a few iterations are enough.",
                "More than rounding to grey levels hides.",
            ],
        );
    }
    // One step from the previous pixel's d, off by e, leaves e² / (2 (1 + e)); here from the walk of one step.
    let walked = errors(60.0, 1);
    let predicted = walked.windows(2).enumerate().map(|(k, pair)| {
        let (sin, cos) = libm::sincos(30.0_f64.to_radians());
        let length = |k: usize| {
            let t = (k as f64 + 0.5) / PIXELS as f64;
            libm::hypot(sin * (2.0 * t - 1.0), cos)
        };
        let e = (1.0 + pair[0]) * length(k) / length(k + 1) - 1.0;
        (pair[1] - e * e / (2.0 * (1.0 + e))).abs()
    });
    let off = predicted.fold(0.0, f64::max);
    content.adds(
        "theory",
        "the same with 1 step, against e² / (2 (1 + e)): largest difference",
        (off, ""),
        if off < 1e-6 {
            "The error is what theory says, rounding aside."
        } else {
            "Theory does not explain the error."
        },
    );
    let steps: Vec<f64> = (1..=35).map(|i| 5.0 * f64::from(i)).collect();
    let limit = |count: u32| {
        steps
            .iter()
            .copied()
            .take_while(|&d| largest(&errors(d, count)) < invisible)
            .last()
    };
    for count in STEPS {
        let degrees = limit(count).unwrap_or(0.0);
        content.adds(
            format!("limit-{count}"),
            format!(
                "{}: largest angle over {PIXELS} pixels without a visible error",
                plural(count)
            ),
            (degrees, "degrees"),
            format!(
                "That is {}° a pixel; in steps of 5°, half a grey level counts as visible.",
                written(degrees / PIXELS as f64)
            ),
        );
    }
}

/// Normals that nearly cancel: the length falls to almost nothing and grows again within a pixel or two.
fn opposed(content: &mut Content) -> Result<(), FigureError> {
    const DEGREES: f64 = 179.9;
    let (sin, cos) = libm::sincos(DEGREES.to_radians() / 2.0);
    let [from, to] = [DVec3::new(-sin, 0.0, cos), DVec3::new(sin, 0.0, cos)];
    let corner = |x: f64, y: f64, normal| Corner::new([x, y], normal);
    let strip = [
        corner(0.0, 0.0, from),
        corner(31.0, 0.0, to),
        corner(31.0, 6.0, to),
        corner(0.0, 6.0, from),
    ];
    let frame = frame(
        [31, 6],
        &Grey::dull(DVec3::new(1.0, 0.0, 0.6)),
        &[Facet::new(strip)],
    )?;
    let naive = Variant::parse("naive-phong")?.render_linear(&frame);
    let mut shown = Vec::from([Shown::new(
        "naive Phong",
        "Almost opposed normals, shaded by naive Phong.",
        stored(&naive),
    )]);
    let (mut worst, mut not_finite) = (Vec::new(), 0);
    for steps in STEPS {
        let fast = Variant::parse(&format!("fast-phong:steps={steps}"))?.render_linear(&frame);
        let differences = fast
            .texels()
            .iter()
            .zip(naive.texels())
            .map(|(a, b)| 255.0 * f64::from((a[0] - b[0]).abs()));
        worst.push(differences.fold(0.0, f64::max));
        not_finite += fast
            .texels()
            .iter()
            .filter(|texel| !texel[0].is_finite())
            .count();
        let alt = format!("The same by fast Phong with {}.", plural(steps));
        shown.push(Shown::new(
            format!("fast Phong, {}", plural(steps)),
            alt,
            stored(&fast),
        ));
    }
    content.text(format!(
        "Where the normals at the ends are almost opposed ({DEGREES}° here, over 31 pixels, one of them in the middle), d falls to almost nothing in \
         the middle and grows again by a large factor a pixel. A step from a guess that is far too small overshoots to \
         about d² / 2x, and the span is dark until the steps have come down again."
    ));
    content.pictures(2, shown);
    for (steps, worst) in STEPS.into_iter().zip(worst) {
        let breaks = worst > 1.0;
        content.claim(
            format!("opposed-{steps}"),
            format!(
                "normals {DEGREES}° apart, {}: largest difference from naive Phong",
                plural(steps)
            ),
            (worst, "grey levels"),
            !breaks,
            [
                "Still not visible.",
                "Few iterations are not enough where normals nearly cancel.",
            ],
        );
    }
    content.adds(
        "not-finite",
        "pixels there that are infinite or not a number",
        (not_finite as f64, "pixels"),
        if not_finite == 0 {
            "Wrong, but always a number."
        } else {
            "Some pixels are not numbers."
        },
    );
    Ok(())
}
