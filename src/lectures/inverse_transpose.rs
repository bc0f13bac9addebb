//! Normals under a transform that stretches: by the matrix of the points, and by its inverse transpose (CS171 2, Figure 4).

use super::lit::{drawn, grey, levels, scene, shown};
use super::stage::written;
use super::{Content, Figure, FigureError, Plot, Scale, Series};
use crate::mesh::builtin::builtin;
use crate::mesh::vertex_normals::NormalSource;
use crate::mesh::{GivenNormals, MeshBuilder, PolygonMesh};
use crate::scene::Scene;
use alloc::format;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DAffine3, DVec3};

pub(super) static FIGURE: Figure = Figure {
    name: "inverse-transpose",
    title: "Normals of a stretched surface",
    lecture: "CS171 2, Surface normals, Figure 4",
    make,
};

/// By what the circle and the sphere are stretched across.
const STRETCH: f64 = 2.5;
const LIGHT: DVec3 = DVec3::new(-0.7, 0.5, 0.5);

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    ellipse(&mut content);
    ellipsoid(&mut content)?;
    Ok(content)
}

/// The angle between a normal and the true one, in degrees.
fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a.normalize(), b.normalize());
    (2.0 * libm::atan2((a - b).length(), (a + b).length())).to_degrees()
}

/// Around the ellipse of Figure 4: the true normal is at right angles to the tangent.
fn ellipse(content: &mut Content) {
    let around = |degrees: f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        // The tangent of the circle, stretched as its points are, turned back by a right angle.
        let tangent = DVec3::new(-STRETCH * sin, cos, 0.0);
        let truth = DVec3::new(tangent.y, -tangent.x, 0.0);
        let by_matrix = DVec3::new(STRETCH * cos, sin, 0.0);
        let by_inverse_transpose = DVec3::new(cos / STRETCH, sin, 0.0);
        (angle(by_matrix, truth), angle(by_inverse_transpose, truth))
    };
    let degrees = || (0..=72).map(|i| 5.0 * f64::from(i));
    content.plot(Plot {
        title: format!("Normals around a circle stretched by {STRETCH}: angle from the true ones"),
        x: ("place on the circle, degrees".into(), Scale::Linear),
        y: ("error, degrees".into(), Scale::Linear),
        series: vec![
            Series::new(
                "by the matrix of the points",
                degrees().map(|d| (d, around(d).0)),
            ),
            Series::new(
                "by its inverse transpose",
                degrees().map(|d| (d, around(d).1)),
            ),
        ],
        marks: Vec::new(),
        caption:
            "At the ends of the axes both are right: that is what the arrows of Figure 4 show."
                .into(),
    });
    let largest = |of: fn((f64, f64)) -> f64| degrees().map(|d| of(around(d))).fold(0.0, f64::max);
    let (wrong, right) = (largest(|errors| errors.0), largest(|errors| errors.1));
    let is_wrong = wrong > 1.0;
    content.claim(
        "matrix",
        "largest error of normals by the matrix of the points",
        (wrong, "degrees"),
        is_wrong,
        [
            "They are no normals, as the notes say.",
            "They are normals.",
        ],
    );
    // Both vectors are computed from the same sine and cosine, in a few roundings of 2⁻⁵³ each.
    let is_right = right < 1e-6;
    content.claim(
        "inverse-transpose",
        "largest error of normals by the inverse transpose",
        (right, "degrees"),
        is_right,
        [
            "They are at right angles to the surface, to rounding.",
            "They are not normals either.",
        ],
    );
}

fn stretch(v: DVec3) -> DVec3 {
    DVec3::new(STRETCH * v.x, v.y, v.z)
}

/// A mesh of the ellipsoid itself; the normals that it brings are stretched like its points: what the notes warn of.
fn stretched() -> Result<PolygonMesh, FigureError> {
    let sphere = builtin("sphere?rings=32&segments=64")?;
    let stretched = sphere.positions().iter().map(|p| stretch(p.as_dvec3()));
    let mut mesh = MeshBuilder::new(stretched.clone().map(|p| p.as_vec3()).collect());
    sphere.polygons().for_each(|polygon| {
        mesh.polygon(polygon);
    });
    // The normal of a unit sphere is its position, so that the stretched normal is the stretched position.
    mesh.normals(GivenNormals {
        values: stretched.map(|n| n.normalize().as_vec3()).collect(),
        corners: None,
    });
    Ok(mesh.finish()?)
}

fn lit(mesh: PolygonMesh, source: NormalSource, transform: DAffine3) -> Result<Scene, FigureError> {
    let mut scene = scene(mesh, grey(0.06, 0.6, 0.34, 30.0), LIGHT, 1.15, [208, 84]);
    for object in &mut scene.objects {
        (object.normals, object.transform) = (source, transform);
    }
    Ok(scene)
}

/// An ellipsoid by the engine, by its own polygons, and with the wrong normals.
fn ellipsoid(content: &mut Content) -> Result<(), FigureError> {
    let sphere = || builtin("sphere?rings=32&segments=64");
    let by_scale = DAffine3::from_scale(DVec3::new(STRETCH, 1.0, 1.0));
    // A light that reaches the middle, as an ellipsoid of this width fills the picture.
    let draw = |scene: Scene| drawn(&scene, "naive-phong");
    let right = draw(lit(sphere()?, NormalSource::Given, by_scale)?)?;
    // Averages are taken before the transform: of the stretched polygons only where the mesh itself is stretched.
    let polygons = draw(lit(
        stretched()?,
        NormalSource::Averaged,
        DAffine3::IDENTITY,
    )?)?;
    let wrong = draw(lit(stretched()?, NormalSource::Given, DAffine3::IDENTITY)?)?;
    content.text("A sphere stretched into an ellipsoid. The engine transforms its normals by the inverse transpose; beside it the normals that its matrix makes of them.");
    let what = "An ellipsoid with a highlight, normals";
    content.pictures(
        2,
        [
            shown(what, "by the inverse transpose", &right),
            shown(what, "by the matrix", &wrong),
        ]
        .into(),
    );
    let (near, far) = (levels(&right, &polygons), levels(&right, &wrong));
    let holds = near < far / 4.0;
    content.claim("engine", "engine's normals against those averaged from its polygons, largest difference", (near, "grey levels"), holds, [format!(
                "The polygons confirm the inverse transpose; by the matrix the difference is {} levels.",
                written(far)
            ), "The polygons do not confirm the inverse transpose.".into()]);
    let visible = far > 8.0;
    content.claim(
        "picture",
        "by the matrix against by the inverse transpose, largest difference",
        (far, "grey levels"),
        visible,
        [
            "The light is on the wrong part of the surface.",
            "The light hardly moves.",
        ],
    );
    Ok(())
}
