//! Normals under a transform that stretches: by the matrix that moves the points, and by its
//! inverse transpose (CS171 2, Figure 4).

use super::prelude::*;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::{GivenNormals, MeshBuilder, PolygonMesh};
use fastphong::scene::Object;

pub(super) static FIGURE: Figure = Figure {
    name: "inverse-transpose",
    title: "Normals of a stretched surface",
    lecture: "CS171 2, Surface normals, Figure 4",
    parts: &[ellipse, ellipsoid],
    live: None,
};

/// The factor that stretches the circle and the sphere sideways.
const STRETCH: f64 = 2.5;
const LIGHT: DVec3 = DVec3::new(-0.7, 0.5, 0.5);

/// Compares normals around the ellipse of Figure 4. The true normal is at right angles to the
/// tangent.
fn ellipse(content: &mut FigureContent) -> Result {
    let error = |degrees: f64, normal: fn(f64, f64) -> DVec3| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        // Stretch the circle's tangent like its points, then turn it back by a right angle.
        let tangent = DVec3::new(-STRETCH * sin, cos, 0.0);
        let truth = DVec3::new(tangent.y, -tangent.x, 0.0);
        angle(normal(sin, cos).normalize(), truth.normalize())
    };
    let by_matrix = |degrees| error(degrees, |sin, cos| DVec3::new(STRETCH * cos, sin, 0.0));
    let by_inverse_transpose =
        |degrees| error(degrees, |sin, cos| DVec3::new(cos / STRETCH, sin, 0.0));
    let degrees = || (0..=72).map(|i| 5.0 * f64::from(i));
    content.plot(Plot::new(
        format!("Normals around a circle stretched by {STRETCH}: angle from the true normals"),
        ["position on the circle, degrees", "error, degrees"].map(linear),
        [
            Series::sampled("by the matrix of the points", degrees(), by_matrix),
            Series::sampled("by its inverse transpose", degrees(), by_inverse_transpose),
        ],
        "At the ends of the axes both are right, as the arrows in Figure 4 show.",
    ));
    let wrong = largest(degrees().map(by_matrix));
    content.confirms(
        "matrix | largest error of normals by the matrix of the points",
        (wrong, "degrees", wrong > 1.0),
        "They are not normals, as the notes say.",
    );
    // Both vectors are computed from the same sine and cosine, in a few roundings of 2⁻⁵³ each.
    let right = largest(degrees().map(by_inverse_transpose));
    content.confirms(
        "inverse-transpose | largest error of normals by the inverse transpose",
        (right, "degrees", right < 1e-6),
        "Apart from rounding they are at right angles to the surface.",
    );
    Ok(())
}

const SPHERE: &str = "sphere?rings=32&segments=64";

/// Makes a mesh of the ellipsoid itself. Its normals are stretched like its points: the mistake
/// that the notes warn of.
fn stretched() -> Result<PolygonMesh> {
    let sphere = builtin(SPHERE)?;
    let across = DVec3::new(STRETCH, 1.0, 1.0);
    let stretched = sphere.positions().iter().map(|p| p.as_dvec3() * across);
    let mut mesh = MeshBuilder::new(stretched.clone().map(|p| p.as_vec3()).collect());
    sphere.polygons().for_each(|polygon| {
        mesh.polygon(polygon);
    });
    // On a unit sphere normals equal positions, so a stretched normal is a stretched position.
    mesh.normals(GivenNormals {
        values: stretched.map(|n| n.normalize().as_vec3()).collect(),
        corners: None,
    });
    Ok(mesh.finish()?)
}

fn lit(mesh: PolygonMesh, normals: NormalSource, transform: DAffine3) -> Result<LinearPicture> {
    let material = grey(0.06, 0.6, 0.34, 30.0);
    let mut scene = scene(SPHERE, material, LIGHT, 1.15, [208, 84])?;
    let mut object = Object::new(mesh);
    object.material = Some(material);
    object.normals = normals.into();
    object.transform = transform;
    scene.objects = vec![object];
    draw(&scene.frame()?, "naive-phong")
}

/// Draws an ellipsoid three times: with the engine's normals, with normals averaged from its
/// polygons, and with the wrong normals.
fn ellipsoid(content: &mut FigureContent) -> Result {
    let by_scale = DAffine3::from_scale(DVec3::new(STRETCH, 1.0, 1.0));
    let right = lit(builtin(SPHERE)?, NormalSource::Given, by_scale)?;
    // The engine averages normals before the transform. To average those of the stretched polygons,
    // the mesh itself must be stretched.
    let polygons = lit(stretched()?, NormalSource::Averaged, DAffine3::IDENTITY)?;
    let wrong = lit(stretched()?, NormalSource::Given, DAffine3::IDENTITY)?;
    content.text(
        "A sphere stretched into an ellipsoid. The engine transforms its normals by the inverse \
         transpose; the other picture transforms them by the matrix of the points.",
    );
    content.row(
        "An ellipsoid with a highlight, normals",
        "by the inverse transpose | by the matrix",
        [&right, &wrong].map(stored),
    );
    let (near, far) = (levels(&right, &polygons), levels(&right, &wrong));
    let off = written(far);
    content.confirms(
        "engine | the engine's normals against normals averaged from its polygons, largest difference",
        (near, "grey levels", near < far / 4.0),
        &format!("The polygons confirm the inverse transpose: the matrix is off by {off} levels."),
    );
    content.confirms(
        "picture | by the matrix against by the inverse transpose, largest difference",
        (far, "grey levels", far > 8.0),
        "The light is on the wrong part of the surface.",
    );
    Ok(())
}
