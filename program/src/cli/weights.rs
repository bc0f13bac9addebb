//! `fastphong compare --weights`: compares the ways to weight vertex normals.

use super::CliError;
use fastphong::compare::metrics::compare;
use fastphong::mesh::PolygonMesh;
use fastphong::mesh::vertex_normals::{
    NormalRule, NormalSource, NormalUse, NormalWeight, vertex_normals,
};
use fastphong::picture::LinearPicture;
use fastphong::raster::Renderer;
use fastphong::scene::{Object, Scene};
use fastphong::shading::Variant;

const WEIGHTS: [(&str, NormalWeight); 4] = [
    ("uniform", NormalWeight::Uniform),
    ("area", NormalWeight::Area),
    ("angle", NormalWeight::Angle),
    ("max", NormalWeight::Max),
];

/// Returns the table of weights. For each weight, it averages the normals of all objects, measures
/// their angles from the normals of the meshes (or, where a mesh has none, from averages by angle),
/// and compares the pictures.
///
/// # Errors
/// If the scene cannot be projected.
pub fn table(name: &str, scene: &Scene) -> Result<String, CliError> {
    let truth: Vec<NormalRule> = scene.objects.iter().map(truth).collect();
    let is_given = |rule: &NormalRule| rule.source == NormalSource::Given;
    let against = match (truth.iter().all(is_given), truth.iter().any(is_given)) {
        (true, _) => "the normals of the mesh",
        (false, false) => "averages by angle",
        (false, true) => "the normals of the meshes, and averages by angle where they have none",
    };
    let picture = drawn(scene, &truth)?;
    let mut text = format!(
        "{name}: averaged normals, and the picture with them, against {against}\n\
         weight     normals: degrees, RMS  largest   picture: levels, RMS  largest\n"
    );
    for (word, weight) in WEIGHTS {
        let rules = scene.objects.iter().map(|object| averaged(object, weight));
        let rules: Vec<NormalRule> = rules.collect();
        let [rms, most] = degrees(scene, &truth, &rules);
        let difference = compare(&picture, &drawn(scene, &rules)?)?;
        let levels = [difference.rms, difference.max].map(|error| 255.0 * error);
        text += &format!(
            "{word:10} {rms:22.2} {most:8.1} {:23.2} {:8.1}\n",
            levels[0], levels[1]
        );
    }
    text += "--normals-weight WEIGHT draws with one of them\n";
    Ok(text)
}

/// Returns the rule whose normals count as right.
fn truth(object: &Object) -> NormalRule {
    let used = NormalUse::of(&object.mesh, NormalSource::Given);
    match used.averaged {
        0 => NormalSource::Given.into(),
        _ => averaged(object, NormalWeight::Angle),
    }
}

/// Returns the rule that averages by `weight`, with the object's crease if it has one. Normals of
/// the mesh are ignored.
fn averaged(object: &Object, weight: NormalWeight) -> NormalRule {
    let source = match object.normals.source {
        NormalSource::Crease(degrees) => NormalSource::Crease(degrees),
        NormalSource::Averaged | NormalSource::Auto | NormalSource::Given => NormalSource::Averaged,
    };
    NormalRule { source, weight }
}

/// Draws a scene with a rule for each object.
fn drawn(scene: &Scene, rules: &[NormalRule]) -> Result<LinearPicture, CliError> {
    let mut scene = scene.clone();
    for (object, rule) in scene.objects.iter_mut().zip(rules) {
        object.normals = *rule;
    }
    let frame = scene.frame()?;
    let (method, _) = Variant::auto(&frame, Renderer::fastest());
    Ok(method.render_linear(&frame)?)
}

/// Returns the RMS and the largest angle between the normals by two rules, in degrees, over all
/// corners.
fn degrees(scene: &Scene, truth: &[NormalRule], rules: &[NormalRule]) -> [f64; 2] {
    let (mut squares, mut most, mut count) = (0.0, 0.0f64, 0);
    for (object, (truth, rule)) in scene.objects.iter().zip(truth.iter().zip(rules)) {
        for angle in angles(&object.mesh, *truth, *rule) {
            squares += angle * angle;
            most = most.max(angle);
            count += 1;
        }
    }
    [(squares / f64::from(count.max(1))).sqrt(), most]
}

/// Returns, for each corner, the angle between the normals by two rules, in degrees.
fn angles(mesh: &PolygonMesh, a: NormalRule, b: NormalRule) -> Vec<f64> {
    let [a, b] = [a, b].map(|rule| vertex_normals(mesh, rule));
    let corners = a.corners.iter().zip(&b.corners);
    let angle = |(&i, &j): (&u32, &u32)| {
        let [a, b] = [a.values[i as usize], b.values[j as usize]].map(|n| n.as_dvec3());
        (2.0 * (a - b).length().atan2((a + b).length())).to_degrees()
    };
    corners.map(angle).collect()
}
