//! Spherical linear interpolation: its speed, how its recurrences drift, and what happens near 0°
//! and 180° (L21 4.4).

use super::prelude::*;
use fastphong::number::Counter;
use fastphong::raster::normals;
use fastphong::reference::{self, Model};
use fastphong::shading::walks::GreatCircle;
use fastphong::shading::walks::sines::Sines;

pub(super) static FIGURE: Figure = Figure {
    name: "slerp",
    title: "Slerp: uniform speed, the drift of its recurrences, and angles near 0° and 180°",
    lecture: "L21 4.4: (4.7)–(4.12)",
    parts: &[speed, operations, drift, ends_of_range],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "The weights sin((1 − t)φ) / sin φ and sin(tφ) / sin φ turn the normal at uniform speed from one end to the other (L21 4.7).",
    handles: &[
        Handle::slider(
            ["angle", "angle of the span", "°"],
            [1.0, 178.0],
            1.0,
            120.0,
        ),
        Handle::slider(
            ["pixels", "pixels of the span", ""],
            [8.0, 128.0],
            8.0,
            64.0,
        ),
    ],
    make: |content, values| speeds(content, values[0], values[1] as u32),
};

/// How many pixels the span has whose normals are compared.
const SPAN: u32 = 64;
/// How many pixels the long span has, along which recurrences drift.
const LONG: usize = 1024;

/// Makes a strip of `pixels` pixels between normals `degrees` apart, lit from the upper right.
fn strip(degrees: f64, pixels: u32) -> Result<Frame> {
    let strip = ScreenPolygon::strip([0.0, pixels.into()], 4.0, ends(degrees));
    let light = DVec3::new(0.3, 0.4, 0.8);
    frame([pixels, 4], grey(0.1, 0.5, 0.4, 20.0), light, &[strip])
}

/// Returns the angle from each vector to the next, in degrees.
fn turns(vectors: Vec<DVec3>) -> Vec<f64> {
    let units: Vec<_> = vectors.iter().map(|v| v.normalize()).collect();
    let turn = |pair: &[DVec3]| angle(pair[1], pair[0]);
    units.windows(2).map(turn).collect()
}

/// Measures the speed along the figure's own span.
fn speed(content: &mut FigureContent) -> Result {
    speeds(content, 120.0, SPAN)
}

/// Measures how many degrees per pixel normals turn, interpolated linearly and along a great
/// circle.
fn speeds(content: &mut FigureContent, degrees: f64, pixels: u32) -> Result {
    let picture = normals(&strip(degrees, pixels)?);
    let linear_normals = picture.row(2).iter().map(|pixel| {
        let [x, y, z, _] = pixel.map(|c| 2.0 * f64::from(c) - 1.0);
        DVec3::new(x, y, z)
    });
    let dt = 1.0 / pixels as f32;
    let face = vec3([0.0, 0.0, 1.0]);
    let normals = ends(degrees).map(|n| vec3(n.as_vec3().to_array()));
    let mut circle = GreatCircle::new(face, normals, 0.5 * dt, dt);
    let [from, to] = [circle.from, circle.to].map(|n| DVec3::from_array(n.array().map(f64::from)));
    let great_circle = (0..pixels).map(|_| {
        let (s_from, s_to) = circle.sines.next();
        f64::from(s_from) * from + f64::from(s_to) * to
    });
    let [lerp, slerp] = [linear_normals.collect(), great_circle.collect()].map(turns);
    let curve = |(name, turns): (&str, &Vec<f64>)| {
        Series::new(name, (1..).map(f64::from).zip(turns.iter().copied()))
    };
    content.text(format!(
        "How far the unit normal turns at each of {pixels} pixels, between normals {degrees}° apart.",
    ));
    let curves = [("linear, then normalised", &lerp), ("great circle", &slerp)];
    content.plot(Plot::new(
        "Speed of the normal along a span",
        [linear("column, pixels"), linear("turn, degrees per pixel")],
        curves.map(curve),
        "A point that moves along a chord at uniform speed turns fastest where it is closest to the middle \
         of the circle.",
    ));
    let ratio = |turns: Vec<f64>| {
        let least = turns.iter().copied().fold(f64::INFINITY, f64::min);
        largest(turns) / least
    };
    let (slerp, lerp) = (ratio(slerp), ratio(lerp));
    content.confirms(
        "speed-slerp | great circle: fastest turn over slowest turn",
        (slerp, "", slerp < 1.001),
        "Uniform speed, as the lecture says.",
    );
    let whole = written(1.0 / libm::pow(libm::cos(degrees.to_radians() / 2.0), 2.0));
    content.adds(
        "speed-linear | linear, then normalised: fastest turn over slowest turn",
        (lerp, "", true),
        &format!("From end to end of the span it would be 1 / cos² of half the angle: {whole}."),
    );
    Ok(())
}

/// Counts the operations of (4.9)–(4.12).
fn operations(content: &mut FigureContent) -> Result {
    let counter = Counter::default();
    let [phi, t0, dt] = [0.5, 0.1, 0.01].map(|x| counter.counted(x));
    let mut sines = Sines::new(phi, t0, dt);
    counter.take();
    sines.next();
    let step = counter.take();
    let (additions, multiplications) = (step.additions, step.multiplications);
    let others = step.divisions + step.roots + step.trigonometric;
    let is_as_said = (additions, multiplications, others) == (4, 8, 0);
    content.confirms(
        "step | additions and multiplications of (4.9) to (4.12)",
        (additions + multiplications, "operations", is_as_said),
        "4 additions and 8 multiplications, counted by the method's own walk.",
    );
    Ok(())
}

/// Walks J = L · N along a great circle by three recurrences in `f32`. Returns their errors,
/// compared with the cosine in `f64`.
fn recurrences(degrees: f64) -> [Vec<f64>; 3] {
    let phi = degrees.to_radians();
    let delta = phi / LONG as f64;
    // L stands 40° from the first normal, in the plane of both normals: J(k) = cos(kδ − 40°).
    let j = |k: f64| libm::cos(k * delta - 40f64.to_radians());
    let errors = |walk: &mut dyn FnMut() -> f32| {
        let error = |k| (f64::from(walk()) - j(k as f64)).abs();
        (0..LONG).map(error).collect()
    };
    let [first, last] = [0.0, LONG as f64].map(|k| (j(k) / libm::sin(phi)) as f32);
    let mut sines = Sines::new(phi as f32, 0.0, 1.0 / LONG as f32);
    let goldman = errors(&mut || {
        let (s_first, s_last) = sines.next();
        first * s_first + last * s_last
    });
    let twice = (2.0 * libm::cos(delta)) as f32;
    let (mut here, mut next) = (j(0.0) as f32, j(1.0) as f32);
    let chebyshev = errors(&mut || {
        let out = here;
        (here, next) = (next, twice * next - here);
        out
    });
    let alpha = (4.0 * libm::pow(libm::sin(delta / 2.0), 2.0)) as f32;
    let (mut value, mut step) = (j(0.0) as f32, (j(1.0) - j(0.0)) as f32);
    let difference = errors(&mut || {
        let out = value;
        value += step;
        step -= alpha * value;
        out
    });
    [goldman, chebyshev, difference]
}

fn drift(content: &mut FigureContent) -> Result {
    const DEGREES: f64 = 30.0;
    const NAMES: [(&str, &str); 3] = [
        ("goldman", "rotation (4.9)–(4.12), of slerp Phong"),
        ("chebyshev", "Chebyshev: 2 cos δ F_k − F_(k−1)"),
        ("difference", "difference form: F += dF; dF −= α F"),
    ];
    let all = recurrences(DEGREES);
    content.plot(Plot::new(
        "Error of J along a long span by three recurrences, in f32",
        [linear("pixel"), log("error of J = L · N")],
        NAMES.iter().zip(&all).map(|((_, name), errors)| {
            let shown = (8..LONG).step_by(8);
            Series::new(*name, shown.map(|k| (k as f64, errors[k].max(1e-9))))
        }),
        format!(
            "{DEGREES}° over {LONG} pixels, compared with the cosine in f64. Chebyshev's recurrence \
             subtracts nearly equal values, so one rounding changes the angle of all later steps. In its \
             difference form α is 4 sin²(δ/2)."
        ),
    ));
    for ((key, name), errors) in NAMES.into_iter().zip(all) {
        let most = largest(errors);
        let verdict = if most > 0.5 / 255.0 {
            "The error is visible."
        } else {
            "The error is not visible."
        };
        content.adds(
            &format!("drift-{key} | {name}: largest error over {LONG} pixels"),
            (most, "", true),
            verdict,
        );
    }
    Ok(())
}

/// Compares the printed formula for φ in `f32` with the true angle, and slerp Phong along the same
/// span with the reference.
fn ends_of_range(content: &mut FigureContent) -> Result {
    let mut rows = Vec::new();
    let (mut worst, mut printed_worst): (f64, f64) = (0.0, 0.0);
    for degrees in [0.0, 1e-3, 0.02, 0.1, 1.0, 90.0, 178.0, 178.9, 179.1, 180.0] {
        let frame = strip(degrees, SPAN)?;
        let drawn = draw(&frame, "slerp-phong")?;
        let exact = reference::render(&frame, Model::Slerp).picture;
        let pairs = drawn.pixels().iter().zip(exact.pixels());
        // `min` turns NaN into 255: a pixel that is not a number counts as wrong by white.
        let levels = |a: f32, b: f64| (255.0 * (f64::from(a) - b).abs()).min(255.0);
        let off = largest(pairs.map(|(a, b)| levels(a[0], b[0])));
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
        let [digits, percent] = if printed.is_finite() {
            [format!("{printed:.4}"), written(100.0 * error)]
        } else {
            ["not a number".into(), "not a number".into()]
        };
        let off = written(off);
        rows.push(format!("{degrees}° | {digits} | {percent} | {off}"));
    }
    content.text(
        "The lecture divides by sin φ and computes φ by the inverse cosine. In f32 the cosine of a small \
         angle rounds to about 1, and at 180° there are many great circles. The method computes φ as \
         2 atan2(|N₂ − N₁|, |N₁ + N₂|). Below 10⁻³ radians it follows the chord. Above 179° it uses the \
         polygon's normal to choose the great circle.",
    );
    content.table(
        "angle of the span | φ as printed, in f32, degrees | error, % | slerp Phong, levels off",
        rows,
    );
    content.contradicts(
        "printed-angle | φ by the inverse cosine in f32, from 0.02° to 90°: largest relative error",
        (printed_worst, "", printed_worst >= 1e-3),
        "The formula as printed loses the angle where surfaces are nearly flat.",
    );
    content.adds(
        "ends | slerp Phong from 0° to 180°: largest difference from the reference",
        (worst, "grey levels", worst < 0.5),
        "The error is not visible at any of these angles.",
    );
    Ok(())
}

/// Computes cos⁻¹(N₁ · N₂) as the lecture prints it, in `f32`, in degrees.
fn printed_angle(ends: [DVec3; 2]) -> f64 {
    let [a, b] = ends.map(|n| n.as_vec3());
    f64::from(libm::acosf(a.x * b.x + a.y * b.y + a.z * b.z)).to_degrees()
}
