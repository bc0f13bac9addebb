//! L and V constant along each polygon, as the lecture assumes, against those of each pixel (L21 1; Duff 1979).

use super::lit::{drawn, grey, levels, scene, shown};
use super::stage::{stored, written};
use super::{Content, Figure, FigureError, Plot, Scale, Series, Shown};
use crate::compare::metrics::difference_map;
use crate::mesh::builtin::builtin;
use crate::reference::{self, Model};
use crate::scene::{Falloff, Interpolation, Light, Scene};
use crate::shading::{SpanBench, Variant};
use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "constant-vectors",
    title: "L and V constant along a polygon, and what that loses",
    lecture: "L21 1, L21 4.3",
    make,
};

/// Bands from pole to pole of the spheres.
const RINGS: [u32; 5] = [6, 12, 24, 48, 96];
/// How far the light is from the surface of the sphere, whose radius is 1.
const DISTANCES: [f64; 4] = [0.25, 1.0, 4.0, 16.0];
const TOWARD: DVec3 = DVec3::new(-0.4, 0.5, 0.77);

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.text(
        "Fast Phong shading takes L·V from 4.6 as a constant of the polygon, and L and V with it. With light and eye at \
         infinity that is exact. With a light at a position it is as good as the polygons are small, or the light is far.",
    );
    let near = sphere(RINGS[1], DISTANCES[0])?;
    let (fast, duff) = (drawn(&near, "fast-phong")?, drawn(&near, "duff-phong")?);
    let map = difference_map(&stored(&duff), &stored(&fast), 64.0)?;
    let mut pictures: Vec<Shown> = [
        ("constant along each polygon (fast-phong)", &fast),
        ("at each pixel (duff-phong)", &duff),
    ]
    .map(|(caption, picture)| {
        shown(
            "A sphere with a light close to it, vectors",
            caption,
            picture,
        )
    })
    .into();
    pictures.push(Shown::new(
        "their difference, to 64 levels",
        "A map of the difference.",
        map,
    ));
    content.pictures(3, pictures);
    errors(&mut content)?;
    products(&mut content, &near)?;
    Ok(content)
}

/// A sphere seen from near by, with a light so far from its surface.
fn sphere(rings: u32, distance: f64) -> Result<Scene, FigureError> {
    let mesh = builtin(&format!("sphere?rings={rings}&segments={}", 2 * rings))?;
    let mut scene = scene(mesh, grey(0.05, 0.5, 0.4, 24.0), DVec3::Z, 1.1, [96, 96]);
    scene.lights = [Light::positional(
        TOWARD.normalize() * (1.0 + distance),
        [1.0; 3],
    )]
    .into();
    scene.local_viewer = true;
    Ok(scene)
}

/// The largest and the RMS error of fast Phong shading over resolutions and distances.
fn errors(content: &mut Content) -> Result<(), FigureError> {
    let fast = Variant::parse("fast-phong")?;
    let mut table = Vec::new();
    let mut curves: Vec<Vec<(f64, f64)>> = Vec::new();
    for distance in DISTANCES {
        let (mut row, mut curve) = (Vec::from([distance.to_string()]), Vec::new());
        for rings in RINGS {
            let frame = sphere(rings, distance)?.frame()?;
            let truth = reference::render(&frame, Model::Phong).to_linear();
            let difference = crate::compare::metrics::compare(&truth, &fast.render_linear(&frame))?;
            row.push(format!(
                "{} / {}",
                written(255.0 * difference.max),
                written(255.0 * difference.rms)
            ));
            curve.push((f64::from(2 * rings * rings), 255.0 * difference.rms));
        }
        table.push(row);
        curves.push(curve);
    }
    let heads = RINGS.map(|rings| format!("{} polygons", 2 * rings * rings));
    let mut head = Vec::from(["light's distance: max / RMS in levels"]);
    head.extend(heads.iter().map(|text| &text[..]));
    content.table(&head, table);
    content.plot(Plot {
        title: "What constant vectors lose: RMS error over the number of polygons".into(),
        x: ("polygons of the sphere".into(), Scale::Log),
        y: ("RMS error, grey levels".into(), Scale::Log),
        series: DISTANCES.iter().zip(&curves).map(|(d, c)| Series::new(format!("light at {d}"), c.clone())).collect(),
        marks: Vec::new(),
        caption: "Radii of the sphere. The eye stays five radii from the middle: what a far light leaves is its part."
            .into(),
    });
    let worst = curves[0][0].1;
    let fine = curves[0][RINGS.len() - 1].1;
    let visible = worst > 1.0;
    content.claim(
        "coarse",
        "RMS error of constant vectors, coarsest sphere and nearest light",
        (worst, "grey levels"),
        !visible,
        [
            "The assumption costs nothing here.",
            "Every polygon shows: the assumption is for lights at infinity.",
        ],
    );
    let finer = f64::from(RINGS[RINGS.len() - 1]) / f64::from(RINGS[0]);
    let steps = libm::log(worst / fine) / libm::log(finer);
    content.adds(
        "order",
        "by which power of the polygons' size the error falls, nearest light",
        (steps, ""),
        if steps > 0.5 {
            "Finer polygons make up for it."
        } else {
            "Finer polygons do not make up for it."
        },
    );
    Ok(())
}

/// The six products: the same picture as naive Phong shading, by additions.
fn products(content: &mut Content, near: &Scene) -> Result<(), FigureError> {
    let [duff, naive] = [
        Variant::parse("duff-phong")?,
        Variant::parse("naive-phong")?,
    ];
    let frame = near.frame()?;
    let difference = levels(&naive.render_linear(&frame), &duff.render_linear(&frame));
    let holds = difference < 0.5;
    content.adds(
        "duff-naive",
        "six quadratics against vectors at each pixel, largest difference",
        (difference, "grey levels"),
        if holds {
            "One picture: the products are exact, to rounding."
        } else {
            "Not the same picture."
        },
    );
    let bench = |lights| SpanBench::local(20.0, lights, Falloff::None, Interpolation::Screen);
    let rows = [("naive-phong", &naive), ("duff-phong", &duff)].map(|(name, variant)| {
        let cells = [1, 2].into_iter().flat_map(|lights| {
            let counts = variant.operations_on(&bench(lights));
            let sum = |of: fn(&crate::number::Counts) -> u32| of(&counts.walk) + of(&counts.shade);
            [
                sum(|c| c.additions),
                sum(|c| c.multiplications),
                sum(|c| c.divisions) + sum(|c| c.roots),
            ]
            .map(|n| n.to_string())
        });
        [name.to_string()].into_iter().chain(cells).collect()
    });
    let head = [
        "operations a pixel",
        "+ (1 light)",
        "×",
        "÷ and √",
        "+ (2 lights)",
        "×",
        "÷ and √",
    ];
    content.table(&head, rows.into());
    let additions = |lights| duff.operations_on(&bench(lights)).walk.additions;
    let (one, two) = (additions(1), additions(2));
    content.adds("additions", "additions a pixel that step the six products of one light, and 1/w²", (f64::from(one), ""), format!(
            "Two each; {} more for a further light, whose L·L, L·N and L·V are new. A falloff needs 1/w².",
            two - one
        ));
    Ok(())
}
