//! From a scene file to a scene: checks values, loads meshes, and fits the camera.

use super::check::Section;
use super::colours::take_neutral_material;
use super::diagnostics::{Origin, SceneError};
use super::lights::{check_distance, light};
use super::normal_source::{StatedNormals, note_normals, spell_out};
use super::sides::Sides;
use super::upright::turn;
use super::value::{Data, SceneTable};
use super::viewpoint::Viewpoint;
use super::visibility::{clipping, hidden_surfaces, samples};
use super::{BUILTIN, SceneFile, shown};
use crate::mesh::orientation::inside_out;
use crate::mesh::vertex_normals::{NormalRule, NormalSource};
use crate::mesh::{Material, PolygonMesh};
use crate::note::{Note, Notes, Setting};
use crate::number::Written;
use crate::scene::camera_fit::bounds;
use crate::scene::direction::{length, unit};
use crate::scene::ranges::{COORDINATE, NumberRange, PIXEL, SIZE, STRENGTH, VOLUME, WELD};
use crate::scene::{Camera, Culling, Light, Object, Scene, volume};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::format;
use std::path::{Path, PathBuf};
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

/// A scene that can be drawn, with notes about it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Resolved {
    /// The scene.
    pub scene: Scene,
    /// What to know before trusting the picture, and what the scene leaves unused or undecided.
    pub notes: Notes,
    /// Keys that the scene leaves open and that its mesh decided. [Laid over](SceneFile::overlay)
    /// the scene file, they make it mean the same wherever it is written down.
    #[doc(hidden)]
    pub chosen: SceneTable,
}

/// A mesh with the notes of its loader, or the error.
pub(crate) type MeshResult = Result<(Arc<PolygonMesh>, Notes), UnusableMesh>;

/// A mesh that a scene names and that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
#[non_exhaustive]
pub struct UnusableMesh {
    /// What is wrong, where, and what was expected: one line.
    pub reason: String,
    /// What was odd before it and may be the cause.
    pub notes: Notes,
}

impl UnusableMesh {
    /// Makes an error without notes.
    pub fn new(reason: impl Into<String>) -> UnusableMesh {
        UnusableMesh {
            reason: reason.into(),
            notes: Notes::default(),
        }
    }
}

/// The part of a scene that may change from picture to picture without loading anything again.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct View {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples per pixel along each side.
    pub samples: u32,
    /// The camera.
    pub camera: Camera,
    /// The lights.
    pub lights: Vec<Light>,
}

/// A view as a scene file states it. A fitted camera still needs the objects.
struct StatedView<'a> {
    width: u32,
    height: u32,
    samples: u32,
    viewpoint: Viewpoint<'a>,
    lights: Vec<Light>,
}

impl<'a> StatedView<'a> {
    fn new(file: &Section<'a>) -> Result<StatedView<'a>, SceneError> {
        let image = file.section("image", "image");
        let width = image.side("width")?.unwrap_or(Scene::DEFAULT_SIZE.0);
        let height = image.side("height")?.unwrap_or(Scene::DEFAULT_SIZE.1);
        let lights = lights(file)?;
        let aspect = f64::from(width) / f64::from(height);
        Ok(StatedView {
            width,
            height,
            viewpoint: Viewpoint::new(file.section("camera", "camera"), aspect)?,
            samples: samples(&image, [width, height])?,
            lights,
        })
    }

    /// Returns the view of objects at `points`.
    fn view(self, file: &Section, points: &[DVec3], notes: &mut Notes) -> Result<View, SceneError> {
        let camera = self.viewpoint.camera(points.iter().copied(), notes)?;
        file.sections("light", "light")
            .try_for_each(|light| check_distance(&light, points, camera.eye))?;
        Ok(View {
            width: self.width,
            height: self.height,
            samples: self.samples,
            camera,
            lights: self.lights,
        })
    }
}

impl SceneFile {
    /// Returns the scene that the file describes.
    ///
    /// `load_mesh` loads each different mesh once. Its arguments are the mesh's name in the file
    /// (`vase.obj`, `builtin:sphere?rings=8`) and the folder to which file names are relative. That
    /// is the folder of the scene file; for meshes that a flag or the program names, it is the
    /// empty path (the current folder). It returns the mesh and the loader's notes.
    ///
    /// # Errors
    /// [`SceneError`] for the first value that is out of its range or contradicts another one, for
    /// a transform that flattens an object, and for a mesh that `load_mesh` refuses.
    pub fn resolve(
        &self,
        load_mesh: impl FnMut(&str, &Path) -> MeshResult,
    ) -> Result<Resolved, SceneError> {
        let scene = self.scene(load_mesh);
        scene.map_err(|error| error.within(&self.source))
    }

    /// Returns the view that the file describes of objects whose polygons use these positions in
    /// the world ([`Scene::world_points`]). It loads nothing.
    ///
    /// # Errors
    /// [`SceneError`] as [`SceneFile::resolve`], for everything that is not about objects.
    pub fn view(&self, points: &[DVec3]) -> Result<View, SceneError> {
        let file = Section {
            table: &self.table,
            name: "",
        };
        let view = StatedView::new(&file);
        let view = view.and_then(|stated| stated.view(&file, points, &mut Notes::default()));
        view.map_err(|error| error.within(&self.source))
    }

    /// Returns the lights and the samples per pixel of [`SceneFile::view`]. It fits no camera and
    /// does not check where lights stand.
    pub(in crate::scene) fn lights_and_samples(&self) -> Result<(Vec<Light>, u32), SceneError> {
        let file = Section {
            table: &self.table,
            name: "",
        };
        let stated = StatedView::new(&file).map_err(|error| error.within(&self.source))?;
        Ok((stated.lights, stated.samples))
    }

    fn scene(
        &self,
        load_mesh: impl FnMut(&str, &Path) -> MeshResult,
    ) -> Result<Resolved, SceneError> {
        let file = Section {
            table: &self.table,
            name: "",
        };
        let image = file.section("image", "image");
        let mut notes = self.notes.clone();
        if let Some(note) = self.view_note() {
            notes.push(note);
        }
        let stated = StatedView::new(&file)?;
        let background = image.channels("background", &PIXEL)?.unwrap_or([0.0; 3]);
        let ambient = file.channels("ambient", &STRENGTH)?;
        let clipping = clipping(&file)?;
        let hidden_surfaces = hidden_surfaces(&file, &mut notes)?;
        let mut objects = self.objects(&file, load_mesh, &mut notes)?;
        let colours = file.table.text("colours") == Some("on");
        let points: Vec<DVec3> = objects.iter().flat_map(Object::world_points).collect();
        let view = stated.view(&file, &points, &mut notes)?;
        let alone = self.mesh_alone(&file, &objects);
        let is_eye_within = || {
            let (eye, around) = (view.camera.eye, bounds(points.iter().copied()));
            around.is_some_and(|(low, high)| low.cmple(eye).all() && eye.cmple(high).all())
        };
        let mut sides = Sides::new(&file, alone, is_eye_within, &mut notes);
        let is_named = file
            .sections("object", "object")
            .any(|object| is_named_in_file(&object));
        if let [object] = &mut objects[..]
            && !is_named
            && colours
            && object.mesh.has_lit_colours()
            && object.mesh.materials().is_empty()
        {
            take_neutral_material(&file, object, &mut sides.chosen);
        }
        // Built-in meshes are correct, and the user stated nothing about them.
        let from_files = objects.iter().zip(self.meshes());
        // Objects that share a mesh and a source of normals would repeat the same notes.
        let mut looked_at = BTreeSet::new();
        for (object, name) in from_files.filter(|(_, name)| !name.starts_with(BUILTIN)) {
            let name = shown(name);
            let normals = match object.normals.source {
                NormalSource::Averaged => (0, 0),
                NormalSource::Auto => (1, 0),
                NormalSource::Given => (2, 0),
                NormalSource::Crease(degrees) => (3, degrees.to_bits()),
            };
            if !looked_at.insert((Arc::as_ptr(&object.mesh), normals)) {
                continue;
            }
            note_normals(name, &object.mesh, object.normals.source, &mut notes);
            let outside = match sides.culling {
                Culling::Back => "so that its outside is not drawn",
                // Its outside is shown, and lit on both sides.
                Culling::Front | Culling::None if sides.two_sided => continue,
                Culling::Front | Culling::None => "so that its outside is lit from within",
            };
            warn_of_inside_out(name, &object.mesh, outside, &mut notes);
        }
        let mut chosen = sides.chosen;
        if let Some(tables) = normals_spelt_out(&file, &objects) {
            chosen.set("object", Data::Tables(tables), Origin::Program);
        }
        let specular = file.word("specular");
        let scene = Scene {
            width: view.width,
            height: view.height,
            background,
            camera: view.camera,
            ambient: ambient.unwrap_or([1.0; 3]),
            lights: view.lights,
            local_viewer: file.table.text("viewer") == Some("local"),
            specular,
            shininess_for: file.choice("shininess_for").unwrap_or(specular),
            gate: file.word("specular_gate"),
            colours,
            interpolation: file.word("interpolation"),
            culling: sides.culling,
            hidden_surfaces,
            clipping,
            two_sided: sides.two_sided,
            samples: view.samples,
            encoding: image.word("encoding"),
            objects,
        };
        Ok(Resolved {
            scene,
            notes,
            chosen,
        })
    }

    /// Returns the objects with their meshes. Each mesh is loaded once.
    fn objects(
        &self,
        file: &Section,
        mut load_mesh: impl FnMut(&str, &Path) -> MeshResult,
        notes: &mut Notes,
    ) -> Result<Vec<Object>, SceneError> {
        let given = file.section("material", "material");
        let default = material(&given, &Material::default())?;
        let mut over_one = Notes::default();
        if file.table.tables("object").is_empty() {
            let expected = "expected at least one [[object]]";
            let problem = "the scene has no objects";
            let error = SceneError::new(Origin::Program, problem, expected);
            return Err(error.help("for example: [[object]] with mesh = \"builtin:sphere\""));
        }
        // Check everything that needs no mesh first, before loading one costs time.
        let placed = file.sections("object", "object").map(|section| {
            let own = section.section("material", "object.material");
            let own = if section.has("material") {
                Some(material(&own, &default)?)
            } else {
                None
            };
            let weld = section.number("weld", &WELD)?;
            Ok((
                section,
                placement(&section)?,
                (StatedNormals::new(&section)?, weld),
                own,
            ))
        });
        let placed = placed.collect::<Result<Vec<_>, _>>()?;
        // Each mesh as it was loaded, and, if an object needs it, with the default material for
        // polygons that had none.
        type Known = [Option<Arc<PolygonMesh>>; 2];
        let mut meshes: BTreeMap<(PathBuf, &str), Known> = BTreeMap::new();
        let mut objects = Vec::with_capacity(placed.len());
        let mut welded: BTreeMap<_, Arc<PolygonMesh>> = BTreeMap::new();
        for (section, transform, (normals, weld), own) in placed {
            let spec = section.table.text("mesh").unwrap_or_default();
            let mesh = match meshes.entry((self.mesh_folder(section.table), spec)) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => {
                    let loaded = load_mesh(spec, &new.key().0);
                    let (mesh, mut odd) = loaded.map_err(|why| mesh_error(&section, spec, &why))?;
                    // Other materials replace those of the file.
                    if !self.draws_materials_of(spec) {
                        odd.remove("material/");
                    }
                    notes.append(odd);
                    new.insert([Some(mesh), None])
                }
            };
            let [Some(loaded), with_default] = mesh else {
                unreachable!("a mesh is there once it was loaded");
            };
            let usual = if is_named_in_file(&section) {
                NormalRule::default()
            } else {
                loaded.normal_rule()
            };
            let has_default = own.is_none() && lacks_material(loaded);
            let own = own.or(loaded.materials().is_empty().then_some(default));
            let mesh = if own.is_some() || given.table.entries.is_empty() {
                loaded.clone()
            } else {
                with_default
                    .get_or_insert_with(|| with_default_material(loaded.clone(), default))
                    .clone()
            };
            let mesh = match weld {
                None => mesh,
                Some(part) => {
                    let known = welded.entry((Arc::as_ptr(&mesh), part.to_bits()));
                    let weld = || {
                        let mut mesh = PolygonMesh::clone(&mesh);
                        mesh.weld(part);
                        Arc::new(mesh)
                    };
                    known.or_insert_with(weld).clone()
                }
            };
            // Warn only about coefficients that are drawn: [material] counts only if an object
            // shows it.
            if section.has("material") {
                let own = section.section("material", "object.material");
                tell_over_one(&[own, given], &mut over_one);
            }
            if has_default {
                tell_over_one(&[given], &mut over_one);
            }
            let object = Object {
                name: shown(spec).into(),
                mesh,
                transform,
                material: own,
                normals: normals.or(usual),
            };
            if !object.world_points().all(|p| COORDINATE.holds_all(p)) {
                let problem = format!("`{spec}` reaches too far");
                let expected = "expected coordinates between -1e15 and 1e15 after the transform";
                return Err(if is_named_in_file(&section) {
                    section.error("mesh", &problem, expected)
                } else {
                    SceneError::new(Origin::Program, problem, expected)
                });
            }
            objects.push(object);
        }
        notes.append(over_one);
        Ok(objects)
    }

    /// Returns the name and the mesh of the only object, if the mesh was read from a file and no
    /// scene file names it.
    fn mesh_alone<'a>(
        &'a self,
        file: &Section,
        objects: &'a [Object],
    ) -> Option<(&'a str, &'a PolygonMesh)> {
        let mut sections = file.sections("object", "object");
        let is_named = sections.any(|object| is_named_in_file(&object));
        match objects {
            [Object { mesh, .. }] if !is_named && mesh.was_read() => {
                self.meshes().next().map(|name| (name, &**mesh))
            }
            _ => None,
        }
    }

    /// Returns the folder to which the mesh path of `object` is relative.
    fn mesh_folder(&self, object: &SceneTable) -> PathBuf {
        let origin = object.get("mesh").map(|mesh| &mesh.origin);
        match (origin, self.path().and_then(Path::parent)) {
            (Some(Origin::File(_)), Some(folder)) => folder.into(),
            _ => PathBuf::new(),
        }
    }
}

/// Returns the lights, or the default one if the scene states none.
fn lights(file: &Section) -> Result<Vec<Light>, SceneError> {
    if !file.has("light") {
        let usual =
            turn(file.table.table("camera")) * unit(DVec3::from_array(Scene::DEFAULT_LIGHT));
        return Ok(vec![Light::directional(usual, [1.0; 3])]);
    }
    if let Some(over) = file.sections("light", "light").nth(Scene::MAX_LIGHTS) {
        let problem = format!("light number {} is one too many", Scene::MAX_LIGHTS + 1);
        let expected = format!("expected {} lights at most", Scene::MAX_LIGHTS);
        return Err(over.table_error(&problem, &expected));
    }
    file.sections("light", "light")
        .zip(1..)
        .map(|(section, number)| light(&section, number))
        .collect()
}

/// Returns the tables of all objects, completed with the vertex normals that meshes choose if no
/// scene file names them. Returns `None` if nothing was added.
fn normals_spelt_out(file: &Section, objects: &[Object]) -> Option<Vec<SceneTable>> {
    let mut tables = file.table.tables("object").to_vec();
    let mut is_any_open = false;
    let sections = file.sections("object", "object");
    for ((section, object), table) in sections.zip(objects).zip(&mut tables) {
        if !is_named_in_file(&section) {
            is_any_open |= spell_out(object.mesh.normal_rule(), table);
        }
    }
    is_any_open.then_some(tables)
}

/// True if a scene file names the mesh of `object`. Otherwise the mesh is the input itself, and
/// there is neither a line of a scene file nor a key to point at.
fn is_named_in_file(object: &Section) -> bool {
    let origin = object.table.get("mesh").map(|value| &value.origin);
    matches!(origin, Some(Origin::File(_)))
}

/// Makes the error for a mesh that could not be loaded; the caret stands under its name.
fn mesh_error(object: &Section, mesh: &str, why: &UnusableMesh) -> SceneError {
    let reason = why.reason.as_str();
    let error = if is_named_in_file(object) {
        object.error("mesh", &format!("`{mesh}` cannot be used"), reason)
    } else {
        SceneError::new(Origin::Program, reason, "")
    };
    if why.notes.is_empty() {
        error
    } else {
        error.note(why.notes.to_string())
    }
}

/// Returns the coefficients in a table, with those of `default` for absent ones.
fn material(section: &Section, default: &Material) -> Result<Material, SceneError> {
    let coefficient = |key| section.channels(key, &STRENGTH);
    let shininess = section.strength("shininess")?;
    Ok(Material {
        ambient: coefficient("ka")?.unwrap_or(default.ambient),
        diffuse: coefficient("kd")?.unwrap_or(default.diffuse),
        specular: coefficient("ks")?.unwrap_or(default.specular),
        shininess: shininess.map_or(default.shininess, |n| n as f32),
    })
}

/// Adds a warning, once, for each coefficient that is above 1 in a channel. The first table that
/// sets a coefficient decides.
fn tell_over_one(tables: &[Section], notes: &mut Notes) {
    for key in ["ka", "kd", "ks"] {
        let Some(section) = tables.iter().find(|section| section.has(key)) else {
            continue;
        };
        let most = section.table.triple(key).map_or(0.0, DVec3::max_element);
        if most <= 1.0 {
            continue;
        }
        let warning = format!(
            "`{}` is {most}: a surface that reflects more light than it gets; expected 0 to 1, as light above 1 is clamped at each pixel",
            section.name(key)
        );
        notes.push(Note::warning("material/over-one", warning));
    }
}

/// True if a polygon has no material of its mesh.
fn lacks_material(mesh: &PolygonMesh) -> bool {
    (0..mesh.polygon_count()).any(|polygon| mesh.polygon_material(polygon).is_none())
}

/// The factors of a scale. [`SIZE`] also has room for the rounding of a rotation.
const SCALE: NumberRange = NumberRange::new(1e-15, 1e15, SIZE.expected);

/// Returns the transform from model space to world space.
fn placement(object: &Section) -> Result<DAffine3, SceneError> {
    if let Some(Data::Matrix(rows)) = object.table.get("matrix").map(|value| &value.data) {
        return from_matrix(object, rows);
    }
    let scale = object.table.triple("scale").unwrap_or(DVec3::ONE);
    let is_wrong = |factor: &f64| !SCALE.holds(factor.abs());
    if let Some(factor) = scale.to_array().into_iter().find(is_wrong) {
        let problem = format!("has the factor {}", Written(factor));
        let expected = "expected factors that are not 0, their sizes between 1e-15 and 1e15";
        return Err(object.error("scale", &problem, expected));
    }
    let mut rotation = DQuat::IDENTITY;
    for turn in object.sections("rotate", "object.rotate") {
        let (axis, angle) = (turn.direction("axis")?, turn.angle("angle", 36_000.0)?);
        if let (Some(axis), Some(angle)) = (axis, angle) {
            rotation = DQuat::from_axis_angle(axis, angle) * rotation;
        }
    }
    let translation = object.point("translate")?.unwrap_or(DVec3::ZERO);
    Ok(DAffine3::from_scale_rotation_translation(
        scale,
        rotation.normalize(),
        translation,
    ))
}

/// Returns the transform that a matrix states.
fn from_matrix(object: &Section, rows: &[[f64; 4]; 3]) -> Result<DAffine3, SceneError> {
    let why = "expected `matrix`, or `scale`, `rotate` and `translate`";
    object.exclude("matrix", "scale rotate translate", why)?;
    if let Some(value) = rows.iter().flatten().find(|v| !COORDINATE.holds(**v)) {
        let problem = format!("has the entry {}", Written(*value));
        let expected = format!("expected {}", COORDINATE.expected);
        return Err(object.error("matrix", &problem, expected));
    }
    let column = |i: usize| DVec3::new(rows[0][i], rows[1][i], rows[2][i]);
    let linear = DMat3::from_cols(column(0), column(1), column(2));
    let sizes = [0, 1, 2].map(|i| length(column(i)));
    if let Some(size) = sizes
        .into_iter()
        .find(|&size| size > 0.0 && !SIZE.holds(size))
    {
        let problem = format!("has a column of length {}", Written(size));
        let expected = format!("expected {}", SIZE.expected);
        return Err(object.error("matrix", &problem, expected));
    }
    if !VOLUME.holds(volume(linear)) {
        let expected = "expected a matrix that can be inverted: columns not in one plane";
        return Err(object.error("matrix", "flattens the object", expected));
    }
    Ok(DAffine3 {
        matrix3: linear,
        translation: column(3),
    })
}

/// Adds a warning, once, if the mesh file `name` is wound inside out.
fn warn_of_inside_out(name: &str, mesh: &PolygonMesh, outside: &str, notes: &mut Notes) {
    let found = inside_out(mesh);
    let polygons = found.polygons;
    let which = match found.surfaces {
        0 => return,
        1 if polygons == mesh.polygon_count() => "the mesh is".into(),
        1 => format!("1 surface of the file, of {polygons} polygons, is"),
        n => format!("{n} surfaces of the file, of {polygons} polygons, are"),
    };
    let text =
        format!("{which} closed and wound inside out, {outside}: turn the faces around, or try ");
    let note = Note::warning("inside-out", text)
        .set(Setting::word("cull", "none"))
        .say(" ")
        .set(Setting::number("two_sided", "true"));
    notes.push(note.about(name));
}

/// Returns the mesh with `default` as the material of every polygon that had none.
fn with_default_material(mut mesh: Arc<PolygonMesh>, default: Material) -> Arc<PolygonMesh> {
    if lacks_material(&mesh) {
        Arc::make_mut(&mut mesh).set_default_material(default);
    }
    mesh
}
