//! Spherical linear interpolation: its speed, the drift of its recurrences, and its ends (L21 4.4).

use super::stage::{Corner, Facet, Grey, frame, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Plot, Scale, Series};
use crate::frame::Frame;
use crate::number::{Counter, vec3};
use crate::raster::normals;
use crate::reference::{self, Model};
use crate::shading::increments::{GreatCircle, Sines};
use crate::shading::{Variant, Walk};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "slerp",
    title: "Slerp: uniform speed, the drift of its recurrences, and angles near 0° and 180°",
    lecture: "L21 4.4: (4.7)–(4.12)",
    make,
};

/// Pixels of the span whose normals are looked at.
const SPAN: usize = 64;
/// Pixels of the long span.
const LONG: usize = 1024;

/// Two unit normals so many degrees apart, alike to the left and to the right of +z.
fn ends(degrees: f64) -> [DVec3; 2] {
    let (sin, cos) = libm::sincos(degrees.to_radians() / 2.0);
    [DVec3::new(-sin, 0.0, cos), DVec3::new(sin, 0.0, cos)]
}

/// A strip of [`SPAN`] pixels between those normals, lit from the upper right.
fn strip(degrees: f64) -> Result<Frame, FigureError> {
    let [from, to] = ends(degrees);
    let w = SPAN as f64;
    let corners = [
        ((0.0, 0.0), from),
        ((w, 0.0), to),
        ((w, 4.0), to),
        ((0.0, 4.0), from),
    ];
    let facet = Facet::new(corners.map(|((x, y), normal)| Corner::new([x, y], normal)));
    let light = DVec3::new(0.3, 0.4, 0.8);
    frame(
        [SPAN as u32, 4],
        &Grey {
            light,
            ambient: 0.1,
            diffuse: 0.5,
            specular: 0.4,
            shininess: 20.0,
        },
        &[facet],
    )
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    speed(&mut content)?;
    operations(&mut content);
    drift(&mut content);
    ends_of_range(&mut content)?;
    Ok(content)
}

/// The angles between neighbouring vectors, in degrees.
fn turns(vectors: &[DVec3]) -> Vec<f64> {
    let angle =
        |a: DVec3, b: DVec3| 2.0 * libm::atan2((b - a).length(), (a + b).length()).to_degrees();
    vectors
        .windows(2)
        .map(|pair| angle(pair[0].normalize(), pair[1].normalize()))
        .collect()
}

/// Degrees a pixel of the two ways to interpolate.
fn speed(content: &mut Content) -> Result<(), FigureError> {
    const DEGREES: f64 = 120.0;
    let picture = normals(&strip(DEGREES)?);
    let linear: Vec<DVec3> = (picture.row(2).iter())
        .map(|texel| DVec3::from_array([0, 1, 2].map(|i| 2.0 * f64::from(texel[i]) - 1.0)))
        .collect();
    let [from, to] = ends(DEGREES).map(|n| vec3(n.as_vec3().to_array()));
    let dt = 1.0 / SPAN as f32;
    let face = vec3([0.0, 0.0, 1.0]);
    let GreatCircle {
        from,
        to,
        mut sines,
    } = GreatCircle::new(face, [from, to], 0.5 * dt, dt);
    let [from, to] = [from, to].map(|n| DVec3::from_array(n.array().map(f64::from)));
    let great: Vec<DVec3> = (0..SPAN)
        .map(|_| {
            let (s_from, s_to) = sines.next();
            f64::from(s_from) * from + f64::from(s_to) * to
        })
        .collect();
    let [linear, great] = [turns(&linear), turns(&great)];
    let points = |turns: &[f64]| {
        turns
            .iter()
            .enumerate()
            .map(|(k, turn)| (k as f64 + 1.0, *turn))
            .collect::<Vec<_>>()
    };
    content.text(format!(
        "Between normals {DEGREES}° apart, over {SPAN} pixels: how far the unit normal turns from pixel to pixel.",
    ));
    content.plot(Plot {
        title: "Speed of the normal along a span".into(),
        x: ("column, pixels".into(), Scale::Linear),
        y: ("turn, degrees a pixel".into(), Scale::Linear),
        series: [Series::new("linear, then normalised", points(&linear)), Series::new("great circle", points(&great))]
            .into(),
        marks: Vec::new(),
        caption:
            "A chord that is walked at uniform speed is seen from the middle of the circle to turn fastest where it \
                  is nearest: in its middle."
                .into(),
    });
    let ratio = |turns: &[f64]| {
        let (least, most) = turns
            .iter()
            .fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), t| {
                (a.min(*t), b.max(*t))
            });
        most / least
    };
    let (slerp, lerp) = (ratio(&great), ratio(&linear));
    let is_uniform = slerp < 1.001;
    content.claim(
        "speed-slerp",
        "great circle: fastest turn by slowest turn",
        (slerp, ""),
        is_uniform,
        [
            "Uniform speed, as the lecture says.",
            "Not a uniform speed.",
        ],
    );
    content.adds(
        "speed-linear",
        "linear, then normalised: fastest turn by slowest turn",
        (lerp, ""),
        format!(
            "1 / cos² of half the angle would be {} over a whole span.",
            written(1.0 / libm::pow(libm::cos(DEGREES.to_radians() / 2.0), 2.0))
        ),
    );
    Ok(())
}

/// What (4.9)–(4.12) cost, counted.
fn operations(content: &mut Content) {
    let counter = Counter::default();
    let [phi, t0, dt] = [0.5, 0.1, 0.01].map(|x| counter.number(x));
    let mut sines = Sines::new(phi, t0, dt);
    counter.take();
    sines.next();
    let step = counter.take();
    let is_as_said = (
        step.additions,
        step.multiplications,
        step.divisions + step.roots + step.trigonometric,
    ) == (4, 8, 0);
    content.found(Finding::new(
        "step",
        "additions and multiplications of (4.9) to (4.12)",
        (f64::from(step.additions + step.multiplications), "operations"),
        Agreement::if_holds(is_as_said),
        format!(
            "{} additions, {} multiplications, {} others, counted by the walk of the method on counting numbers.",
            step.additions,
            step.multiplications,
            step.divisions + step.roots + step.trigonometric
        ),
    ));
}

/// J = L · N along a great circle by three recurrences in `f32`: the errors against the sines themselves in `f64`.
fn recurrences(degrees: f64) -> [Vec<f64>; 3] {
    let phi = degrees.to_radians();
    let delta = phi / LONG as f64;
    // L stands 40° from the first normal, in the plane of both; J(k) = cos(kδ − 40°).
    let j = |k: f64| libm::cos(k * delta - 40f64.to_radians());
    let (first, last) = (
        (j(0.0) / libm::sin(phi)) as f32,
        (j(LONG as f64) / libm::sin(phi)) as f32,
    );
    let mut sines = Sines::new(phi as f32, 0.0, 1.0 / LONG as f32);
    let goldman = || {
        let (s_first, s_last) = sines.next();
        first * s_first + last * s_last
    };
    let (mut here, mut next, twice) = (
        j(0.0) as f32,
        j(1.0) as f32,
        (2.0 * libm::cos(delta)) as f32,
    );
    let chebyshev = || {
        let out = here;
        (here, next) = (next, twice * next - here);
        out
    };
    let alpha = (4.0 * libm::pow(libm::sin(delta / 2.0), 2.0)) as f32;
    let (mut value, mut step) = (j(0.0) as f32, (j(1.0) - j(0.0)) as f32);
    let difference = || {
        let out = value;
        value += step;
        step -= alpha * value;
        out
    };
    let errors = |walk: &mut dyn FnMut() -> f32| {
        (0..LONG)
            .map(|k| (f64::from(walk()) - j(k as f64)).abs())
            .collect()
    };
    let (mut goldman, mut chebyshev, mut difference) = (goldman, chebyshev, difference);
    [
        errors(&mut goldman),
        errors(&mut chebyshev),
        errors(&mut difference),
    ]
}

fn drift(content: &mut Content) {
    const DEGREES: f64 = 30.0;
    let names = [
        (
            "goldman",
            "rotation (4.9)–(4.12)",
            "The walk of slerp Phong",
        ),
        (
            "chebyshev",
            "2 cos δ F_k − F_(k−1)",
            "Chebyshev\u{2019}s recurrence as it is",
        ),
        (
            "difference",
            "F += dF; dF −= α F",
            "Its difference form, α = 4 sin²(δ/2)",
        ),
    ];
    let all = recurrences(DEGREES);
    let series = names.iter().zip(&all).map(|((_, name, _), errors)| {
        Series::new(
            *name,
            (8..LONG)
                .step_by(8)
                .map(|k| (k as f64, errors[k].max(1e-9))),
        )
    });
    content.plot(Plot {
        title: "Error of J along a long span, by recurrence, in f32".into(),
        x: ("pixel".into(), Scale::Linear),
        y: ("error of J = L · N".into(), Scale::Log),
        series: series.collect(),
        marks: Vec::new(),
        caption: format!(
            "{DEGREES}° over {LONG} pixels, against the cosine itself in f64. Chebyshev's recurrence subtracts nearly equal \
             numbers: a rounding becomes an error of the angle of a step, which all later steps repeat."
        ),
    });
    for ((key, name, meaning), errors) in names.iter().zip(&all) {
        let most = errors.iter().copied().fold(0.0, f64::max);
        let is_visible = most > 0.5 / 255.0;
        content.adds(
            format!("drift-{key}"),
            format!("{name}: largest error over {LONG} pixels"),
            (most, ""),
            format!(
                "{meaning}: {}.",
                if is_visible {
                    "a visible error"
                } else {
                    "not visible"
                }
            )
            .to_string(),
        );
    }
}

/// The printed formulas for φ in `f32`, and what the method makes of such a span, against the reference.
fn ends_of_range(content: &mut Content) -> Result<(), FigureError> {
    let slerp = Variant::parse("slerp-phong")?;
    let mut rows = Vec::new();
    let (mut worst, mut printed_worst): (f64, f64) = (0.0, 0.0);
    for degrees in [0.0, 1e-3, 0.02, 0.1, 1.0, 90.0, 178.0, 178.9, 179.1, 180.0] {
        let frame = strip(degrees)?;
        let drawn = slerp.render_linear(&frame);
        let exact = reference::render(&frame, Model::Slerp);
        let pairs = drawn.texels().iter().zip(exact.picture.texels());
        // A pixel that is not a number counts as wrong by white.
        let off = pairs
            .map(|(a, b)| (255.0 * (f64::from(a[0]) - b[0]).abs()).min(255.0))
            .fold(0.0, f64::max);
        worst = worst.max(off);
        let printed = printed_angle(ends(degrees));
        let error = if degrees > 0.0 {
            printed / degrees - 1.0
        } else {
            printed
        };
        if (0.01..=90.0).contains(&degrees) {
            printed_worst = printed_worst.max(error.abs());
        }
        let says = |value: f64| {
            if value.is_finite() {
                written(value)
            } else {
                String::from("not a number")
            }
        };
        let digits = if printed.is_finite() {
            format!("{printed:.4}")
        } else {
            says(printed)
        };
        rows.push(
            [
                format!("{degrees}°"),
                digits,
                says(100.0 * error),
                written(off),
            ]
            .into(),
        );
    }
    content.text(
        "The lecture divides by sin φ and takes φ from the inverse cosine. In f32 the cosine of a small angle is 1, or a \
         little more, and at 180° there is no great circle between the normals, but all of them. The method takes φ from \
         the half-angle form 2 atan2(|N₂ − N₁|, |N₁ + N₂|), keeps to the chord below 10⁻³ radians, and to the normal of \
         the polygon above 179°.",
    );
    content.table(
        &[
            "angle of the span",
            "φ as printed, in f32, degrees",
            "its error, %",
            "slerp Phong, off by levels",
        ],
        rows,
    );
    content.claim(
        "printed-angle",
        "φ by the inverse cosine in f32, from 0.02° to 90°: largest relative error",
        (printed_worst, ""),
        printed_worst < 1e-3,
        [
            "Good enough.",
            "The formula as printed loses the angle where surfaces are flat.",
        ],
    );
    content.adds(
        "ends",
        "slerp Phong from 0° to 180°: largest difference from the reference",
        (worst, "grey levels"),
        if worst < 0.5 {
            "Never visible, at neither end."
        } else {
            "There are angles at which it is visible."
        },
    );
    Ok(())
}

/// cos⁻¹(N₁ · N₂) as the lecture prints it, in `f32`, in degrees.
fn printed_angle(ends: [DVec3; 2]) -> f64 {
    let [a, b] = ends.map(|n| n.as_vec3());
    f64::from(libm::acosf(a.x * b.x + a.y * b.y + a.z * b.z)).to_degrees()
}
