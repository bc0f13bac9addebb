//! From a scene file to a scene: values are checked, meshes loaded, the camera is fitted.

use super::check::{Check, is_coordinate, is_position};
use super::diagnostics::SceneError;
use super::value::{Located, OneOrThree, Origin};
use super::viewpoint::Viewpoint;
use super::{LightSection, MaterialSection, NormalChoice, ObjectSection, SceneFile, ViewerChoice};
use crate::mesh::vertex_normals::NormalSource;
use crate::mesh::{Material, MeshBuilder, PolygonMesh};
use crate::picture::Rgb;
use crate::scene::{Light, MAX_COORDINATE, Object, Scene};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use std::collections::BTreeMap;
use std::format;
use std::path::{Path, PathBuf};
use std::string::String;
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

/// A scene that can be drawn, and what is odd about it.
#[derive(Clone, Debug)]
pub struct Resolved {
    /// The scene.
    pub scene: Scene,
    /// What the user should know, one sentence each.
    pub warnings: Vec<String>,
}

/// A mesh, and what its loader found odd about it; or why there is none.
pub type LoadedMesh = Result<(Arc<PolygonMesh>, Vec<String>), String>;

impl SceneFile {
    /// The scene that the file describes.
    ///
    /// `load_mesh` is asked once for each different mesh: with what the file says (`vase.obj`, `builtin:sphere?rings=8`)
    /// and the folder to which files are relative. That is the folder of the scene file, or the empty path (the current
    /// folder) for meshes named by a flag or by the program.
    ///
    /// # Errors
    /// [`SceneError`] for the first value that is out of its range or contradicts another one, for a transform that
    /// flattens an object, and for what `load_mesh` reports.
    pub fn resolve(
        &self,
        load_mesh: impl FnMut(&str, &Path) -> LoadedMesh,
    ) -> Result<Resolved, SceneError> {
        let check = Check::new(&self.source.0);
        let side = |given: &Option<Located<i64>>, key, default| match given {
            Some(given) => check.side(given, key),
            None => Ok(default),
        };
        let width = side(&self.image.width, "image.width", Self::DEFAULT_SIZE.0)?;
        let height = side(&self.image.height, "image.height", Self::DEFAULT_SIZE.1)?;
        let background = channels(
            &check,
            &self.image.background,
            "image.background",
            1.0,
            [0.0; 3],
        )?;
        let ambient = channels(&check, &self.ambient, "ambient", f64::INFINITY, [1.0; 3])?;
        let lights = self.lights(&check)?;
        let viewpoint = Viewpoint::new(&self.camera, &check)?;
        let samples = self.samples([width, height], &check)?;
        let clipping = self.clipping(&check)?;
        let mut warnings = Vec::new();
        let hidden_surfaces = self.hidden_surfaces(&check, &mut warnings)?;
        let objects = self.objects(&check, load_mesh, &mut warnings)?;
        let points: Vec<DVec3> = objects.iter().flat_map(world_points).collect();
        let aspect = f64::from(width) / f64::from(height);
        let camera = viewpoint.camera(points.iter().copied(), aspect, &check, &mut warnings)?;
        for section in self.light.iter().flatten() {
            section.check_distance(&points, &check)?;
        }
        let specular = self
            .specular
            .as_ref()
            .map_or_else(Default::default, |given| given.value);
        let scene = Scene {
            width,
            height,
            background,
            camera,
            ambient,
            lights,
            local_viewer: self
                .viewer
                .as_ref()
                .is_some_and(|given| given.value == ViewerChoice::Local),
            specular,
            shininess_for: self
                .shininess_for
                .as_ref()
                .map_or(specular, |given| given.value),
            gate: self
                .specular_gate
                .as_ref()
                .map_or_else(Default::default, |given| given.value),
            interpolation: self
                .interpolation
                .as_ref()
                .map_or_else(Default::default, |given| given.value),
            culling: self
                .cull
                .as_ref()
                .map_or_else(Default::default, |given| given.value),
            hidden_surfaces,
            clipping,
            two_sided: self.two_sided.as_ref().is_some_and(|given| given.value),
            samples,
            encoding: self
                .image
                .encoding
                .as_ref()
                .map_or_else(Default::default, |given| given.value),
            objects,
        };
        Ok(Resolved { scene, warnings })
    }

    fn lights(&self, check: &Check) -> Result<Vec<Light>, SceneError> {
        let default = [LightSection::toward(Self::DEFAULT_LIGHT)];
        let sections = self.light.as_deref().unwrap_or(&default);
        if let Some(over) = sections.get(Scene::MAX_LIGHTS) {
            let problem = format!("light number {} is one too many", Scene::MAX_LIGHTS + 1);
            let expected = format!("expected {} lights at most", Scene::MAX_LIGHTS);
            return Err(check.error_at(&over.table.origin, &problem, &expected));
        }
        (1..)
            .zip(sections)
            .map(|(number, section)| section.resolve(number, check))
            .collect()
    }

    fn objects(
        &self,
        check: &Check,
        mut load_mesh: impl FnMut(&str, &Path) -> LoadedMesh,
        warnings: &mut Vec<String>,
    ) -> Result<Vec<Object>, SceneError> {
        let default = material(&self.material, &Material::default(), check, "material")?;
        if self.object.is_empty() {
            return Err(check
                .scene_error(
                    "the scene has no objects",
                    "expected at least one [[object]]",
                )
                .help("for example: [[object]] with mesh = \"builtin:sphere\""));
        }
        // All that can be checked without a mesh is, before the first one costs time.
        let mut placed = Vec::with_capacity(self.object.len());
        for section in &self.object {
            let own = section.material.as_ref();
            let own = own
                .map(|own| material(own, &default, check, "object.material"))
                .transpose()?;
            placed.push((
                section,
                placement(section, check)?,
                normals(section, check)?,
                own,
            ));
        }
        let mut meshes: BTreeMap<(PathBuf, &str), Arc<PolygonMesh>> = BTreeMap::new();
        let mut objects = Vec::with_capacity(placed.len());
        for (section, transform, normals, own) in placed {
            let spec = section.mesh.value.as_str();
            let folder = self.mesh_folder(&section.mesh.origin);
            let mesh = match meshes.get(&(folder.clone(), spec)) {
                Some(mesh) => mesh.clone(),
                None => {
                    let (mesh, found_odd) = load_mesh(spec, &folder)
                        .map_err(|reason| mesh_error(check, &section.mesh, &reason))?;
                    warnings.extend(found_odd);
                    meshes.insert((folder, spec), mesh.clone());
                    mesh
                }
            };
            let (mesh, material) = match own {
                Some(own) => (mesh, Some(own)),
                None if mesh.materials().is_empty() => (mesh, Some(default)),
                None if self.material.is_empty() => (mesh, None),
                None => (with_default_material(mesh, default), None),
            };
            let object = Object {
                mesh,
                transform,
                material,
                normals,
            };
            if !world_points(&object).all(is_position) {
                let problem = format!("`{spec}` reaches too far");
                let expected = "expected coordinates between -1e15 and 1e15 after the transform";
                return Err(check.error(&section.mesh.origin, "object.mesh", &problem, expected));
            }
            objects.push(object);
        }
        Ok(objects)
    }

    /// The folder to which a mesh that was named at `origin` is relative.
    fn mesh_folder(&self, origin: &Origin) -> PathBuf {
        match (origin, self.path().and_then(Path::parent)) {
            (Origin::File(_), Some(folder)) => folder.into(),
            _ => PathBuf::new(),
        }
    }
}

/// The error for a mesh that could not be loaded; the caret stands under its name.
fn mesh_error(check: &Check, mesh: &Located<String>, reason: &str) -> SceneError {
    let problem = format!("`{}` cannot be used", mesh.value);
    match reason.contains('\n') {
        false => check.error(&mesh.origin, "object.mesh", &problem, reason),
        true => check
            .error(&mesh.origin, "object.mesh", &problem, "")
            .note(reason),
    }
}

fn channels(
    check: &Check,
    given: &Option<Located<OneOrThree>>,
    key: &str,
    most: f64,
    default: Rgb,
) -> Result<Rgb, SceneError> {
    given
        .as_ref()
        .map_or(Ok(default), |given| check.channels(given, key, most))
}

/// The coefficients given in `section`, those of `default` where none are.
fn material(
    section: &MaterialSection,
    default: &Material,
    check: &Check,
    table: &str,
) -> Result<Material, SceneError> {
    let coefficient = |given: &Option<Located<OneOrThree>>, key: &str, default: Rgb| {
        channels(
            check,
            given,
            &format!("{table}.{key}"),
            f64::INFINITY,
            default,
        )
    };
    Ok(Material {
        ambient: coefficient(&section.ka, "ka", default.ambient)?,
        diffuse: coefficient(&section.kd, "kd", default.diffuse)?,
        specular: coefficient(&section.ks, "ks", default.specular)?,
        shininess: match &section.shininess {
            Some(given) => check.not_negative(given, &format!("{table}.shininess"))? as f32,
            None => default.shininess,
        },
    })
}

fn normals(section: &ObjectSection, check: &Check) -> Result<NormalSource, SceneError> {
    match (&section.normals, &section.crease) {
        (Some(normals), Some(crease)) => {
            let why = "expected one of them: `crease` averages up to an angle";
            Err(check.conflict(
                "object.crease",
                &crease.origin,
                "object.normals",
                &normals.origin,
                why,
            ))
        }
        (_, Some(crease)) => check
            .number(
                crease,
                "object.crease",
                |v| (0.0..=180.0).contains(&v),
                "degrees between 0 and 180",
            )
            .map(NormalSource::Crease),
        (
            Some(Located {
                value: NormalChoice::Given,
                ..
            }),
            None,
        ) => Ok(NormalSource::Given),
        (
            Some(Located {
                value: NormalChoice::Averaged,
                ..
            })
            | None,
            None,
        ) => Ok(NormalSource::Averaged),
    }
}

/// Model space to world space.
fn placement(section: &ObjectSection, check: &Check) -> Result<DAffine3, SceneError> {
    if let Some(matrix) = &section.matrix {
        return from_matrix(section, matrix, check);
    }
    let scale = match &section.scale {
        Some(given) => {
            let valid =
                |v: f64| v != 0.0 && v.abs() <= MAX_COORDINATE && v.abs() >= 1.0 / MAX_COORDINATE;
            if let Some(value) = given.value.0.into_iter().find(|v| !valid(*v)) {
                let problem = format!("has the factor {value}");
                let expected =
                    "expected factors that are not 0, their sizes between 1e-15 and 1e15";
                return Err(check.error(&given.origin, "object.scale", &problem, expected));
            }
            DVec3::from_array(given.value.0)
        }
        None => DVec3::ONE,
    };
    let mut rotation = DQuat::IDENTITY;
    for turn in section.rotate.iter().flat_map(|rotations| &rotations.0) {
        let axis = check.direction(&turn.axis, "object.rotate.axis")?;
        let expected = "degrees between -36000 and 36000";
        let angle = check.number(
            &turn.angle,
            "object.rotate.angle",
            |v| v.abs() <= 36_000.0,
            expected,
        )?;
        rotation = DQuat::from_axis_angle(axis, angle.to_radians()) * rotation;
    }
    let translation = match &section.translate {
        Some(given) => check.point(given, "object.translate")?,
        None => DVec3::ZERO,
    };
    Ok(DAffine3::from_scale_rotation_translation(
        scale,
        rotation.normalize(),
        translation,
    ))
}

fn from_matrix(
    section: &ObjectSection,
    matrix: &Located<[[f64; 4]; 3]>,
    check: &Check,
) -> Result<DAffine3, SceneError> {
    let others = [
        (
            "object.scale",
            section.scale.as_ref().map(|given| &given.origin),
        ),
        (
            "object.rotate",
            section
                .rotate
                .as_ref()
                .and_then(|r| r.0.first())
                .map(|turn| &turn.axis.origin),
        ),
        (
            "object.translate",
            section.translate.as_ref().map(|given| &given.origin),
        ),
    ];
    for (key, at) in others {
        if let Some(at) = at {
            let why = "expected `matrix`, or `scale`, `rotate` and `translate`";
            return Err(check.conflict("object.matrix", &matrix.origin, key, at, why));
        }
    }
    let rows = matrix.value;
    if let Some(value) = rows.iter().flatten().find(|v| !is_coordinate(**v)) {
        let problem = format!("has the entry {value}");
        return Err(check.error(
            &matrix.origin,
            "object.matrix",
            &problem,
            "expected numbers between -1e15 and 1e15",
        ));
    }
    let column = |i: usize| DVec3::new(rows[0][i], rows[1][i], rows[2][i]);
    let linear = DMat3::from_cols(column(0), column(1), column(2));
    // The volume that a unit cube keeps, measured by its own edges: below this the directions of normals are rounding.
    let edges = column(0).length() * column(1).length() * column(2).length();
    if linear.determinant().abs() <= 1e-12 * edges {
        let expected = "expected a matrix that can be inverted: columns not in one plane";
        return Err(check.error(
            &matrix.origin,
            "object.matrix",
            "flattens the object",
            expected,
        ));
    }
    Ok(DAffine3 {
        matrix3: linear,
        translation: column(3),
    })
}

/// The mesh with `default` as the material of each polygon that had none.
fn with_default_material(mesh: Arc<PolygonMesh>, default: Material) -> Arc<PolygonMesh> {
    if (0..mesh.polygon_count()).all(|polygon| mesh.polygon_material(polygon).is_some()) {
        return mesh;
    }
    let mut materials = mesh.materials().to_vec();
    let own = materials.len();
    materials.push(default);
    let of_polygons = (0..mesh.polygon_count())
        .map(|p| mesh.polygon_material(p).unwrap_or(own) as u32)
        .collect();
    let mut builder = MeshBuilder::new(mesh.positions().to_vec());
    builder.reserve(mesh.polygon_count(), mesh.corners().len());
    for polygon in mesh.polygons() {
        builder.polygon(polygon);
    }
    if let Some(normals) = mesh.given_normals() {
        builder.normals(normals.clone());
    }
    builder.colours(mesh.colours().to_vec());
    builder.materials(materials, of_polygons);
    // Everything but the materials was checked when the mesh was made; were it refused, its own materials would stand.
    builder.finish().map_or(mesh, Arc::new)
}

/// The positions in world space that the polygons of `object` use, each once.
fn world_points(object: &Object) -> impl Iterator<Item = DVec3> {
    let mesh = &object.mesh;
    let mut used = vec![false; mesh.positions().len()];
    for &corner in mesh.corners() {
        used[corner as usize] = true;
    }
    let points = mesh.positions().iter().zip(used);
    points
        .filter(|(_, used)| *used)
        .map(|(p, _)| object.transform.transform_point3(p.as_dvec3()))
}
