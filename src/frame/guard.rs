//! The guard of frames. It checks that the values of a scene, a builder or a span shader are in
//! their ranges (`scene/ranges.rs`); an error names the item and the value. Directions and normals
//! become unit vectors here.
//!
//! A scene's camera, lights and materials are checked each time a frame is made, as they may have
//! changed. Its objects are checked once, when the scene is prepared, and what was passed to a
//! builder is checked when the frame is made.

use super::{FrameError, FrameItem, PlacedModel};
use crate::mesh::Material;
use crate::mesh::vertex_normals::NormalSource;
use crate::scene::direction::{self, as_unit, is_unit};
use crate::scene::ranges::{
    COORDINATE, CREASE, DISTANCE, FAR, FOVY, HALF_HEIGHT, NEAR, NumberRange, PLANE, SIZE, STRENGTH,
    TILT, VOLUME,
};
use crate::scene::{
    Camera, Falloff, Light, LightTerm, Lighting, Object, Place, Projection, Scene, ranges,
    stands_at, volume,
};
use glam::DVec3;

/// The result of a check.
pub(super) type Checked = Result<(), FrameError>;

/// The range of all finite values.
pub(super) const FINITE: NumberRange = NumberRange::new(-f64::MAX, f64::MAX, "a finite number");

/// The range of a direction's length.
const NOT_ZERO: NumberRange = NumberRange::new(
    f64::from_bits(1),
    f64::INFINITY,
    "a direction: not all numbers 0",
);

/// Checks that a value is in its range.
pub(super) fn check(
    item: FrameItem,
    name: &'static str,
    value: impl Into<f64>,
    range: &NumberRange,
) -> Checked {
    let value = value.into();
    if range.holds(value) {
        Ok(())
    } else {
        Err(FrameError::Value {
            item,
            name,
            value,
            expected: range.expected,
        })
    }
}

/// Checks that the values of a list, each with its own name, are in one range.
pub(super) fn check_all<const N: usize>(
    item: FrameItem,
    names: [&'static str; N],
    values: [impl Into<f64>; N],
    range: &NumberRange,
) -> Checked {
    let mut all = names.into_iter().zip(values);
    all.try_for_each(|(name, value)| check(item, name, value, range))
}

/// Checks that a vector has a direction. The last of the names is the name of its length.
pub(super) fn direction(
    item: FrameItem,
    [x, y, z, length]: [&'static str; 4],
    vector: [impl Into<f64>; 3],
) -> Checked {
    let vector = vector.map(Into::into);
    check_all(item, [x, y, z], vector, &FINITE)?;
    let longest = DVec3::from_array(vector).abs().max_element();
    check(item, length, longest, &NOT_ZERO)
}

/// Returns the unit vector along `vector`. A vector that is a unit vector but for rounding, or has
/// no direction, keeps its bits.
pub(crate) fn unit(vector: [f32; 3]) -> [f32; 3] {
    let wide = DVec3::from_array(vector.map(f64::from));
    if is_unit(wide) {
        vector
    } else {
        as_unit(wide).as_vec3().to_array()
    }
}

/// Checks a camera.
pub(super) fn camera(camera: &Camera) -> Checked {
    const ITEM: FrameItem = FrameItem::Camera;
    let places = [
        (["x of the eye", "y of the eye", "z of the eye"], camera.eye),
        (
            ["x of the target", "y of the target", "z of the target"],
            camera.target,
        ),
    ];
    for (names, place) in places {
        check_all(ITEM, names, place.to_array(), &COORDINATE)?;
    }
    let names = ["x of up", "y of up", "z of up", "the length of up"];
    direction(ITEM, names, camera.up.to_array())?;
    let apart = (camera.eye - camera.target).abs().max_element();
    let different = NumberRange::new(f64::from_bits(1), f64::INFINITY, "two different points");
    let name = "the distance from the eye to the target";
    check(ITEM, name, apart, &different)?;
    let tilt = camera.view().cross(direction::unit(camera.up)).length();
    let name = "the sine of the angle between up and the line of sight";
    check(ITEM, name, tilt, &TILT)?;
    match camera.projection {
        Projection::Orthographic { half_height } => {
            check(ITEM, "the half height", half_height, &HALF_HEIGHT)?
        }
        Projection::Perspective { fovy } => check(ITEM, "the field of view", fovy, &FOVY)?,
    }
    let is_perspective = matches!(camera.projection, Projection::Perspective { .. });
    planes([camera.near, camera.far], is_perspective)
}

/// Checks the distances of the near and the far plane.
pub(super) fn planes([near, far]: [f64; 2], is_perspective: bool) -> Checked {
    const ITEM: FrameItem = FrameItem::Camera;
    let range = if is_perspective { &NEAR } else { &PLANE };
    check(ITEM, "the near distance", near, range)?;
    check(ITEM, "the far distance", far, &FAR)?;
    if near < ranges::far(far) {
        Ok(())
    } else {
        Err(no_depth(far))
    }
}

/// Makes the error for planes with nothing between them.
pub(super) fn no_depth(far: f64) -> FrameError {
    FrameError::Value {
        item: FrameItem::Camera,
        name: "the far distance",
        value: far,
        expected: "more than the near distance",
    }
}

/// Checks what does not depend on objects: the ambient light and the lights.
pub(super) fn lights(scene: &Scene) -> Checked {
    let names = [
        "red of the ambient light",
        "green of the ambient light",
        "blue of the ambient light",
    ];
    check_all(FrameItem::Scene, names, scene.ambient, &STRENGTH)?;
    let found = scene.lights.len();
    if found > Scene::MAX_LIGHTS {
        return Err(FrameError::Lights { found });
    }
    let mut lights = scene.lights.iter().enumerate();
    lights.try_for_each(|(index, light)| self::light(index, light))
}

/// Checks a light of a scene.
fn light(index: usize, light: &Light) -> Checked {
    let item = FrameItem::Light(index);
    match light.place {
        Place::Infinite(to) => direction(item, DIRECTION, to.to_array())?,
        Place::Local(at) => check_all(item, POSITION, at.to_array(), &COORDINATE)?,
    }
    check_all(item, COLOUR, light.colour, &STRENGTH)?;
    falloff(item, light.falloff)
}

const DIRECTION: [&str; 4] = [
    "x of its direction",
    "y of its direction",
    "z of its direction",
    "the length of its direction",
];
pub(super) const POSITION: [&str; 3] = [
    "x of its position",
    "y of its position",
    "z of its position",
];
pub(super) const COLOUR: [&str; 3] = [
    "red of its colour",
    "green of its colour",
    "blue of its colour",
];
const AMBIENT: [&str; 3] = [
    "red of its ambient part",
    "green of its ambient part",
    "blue of its ambient part",
];
const DIFFUSE: [&str; 3] = [
    "red of its diffuse part",
    "green of its diffuse part",
    "blue of its diffuse part",
];
const SPECULAR: [&str; 3] = [
    "red of its specular part",
    "green of its specular part",
    "blue of its specular part",
];

fn falloff(item: FrameItem, falloff: Falloff) -> Checked {
    match falloff {
        Falloff::Attenuation(k) => check(item, "its attenuation", k, &STRENGTH),
        Falloff::None | Falloff::InverseSquare | Falloff::Inverse => Ok(()),
    }
}

/// Checks the materials of a scene.
pub(super) fn materials(materials: &[Material]) -> Checked {
    for (index, material) in materials.iter().enumerate() {
        let item = FrameItem::Material(index);
        check_all(item, AMBIENT, material.ambient, &STRENGTH)?;
        check_all(item, DIFFUSE, material.diffuse, &STRENGTH)?;
        check_all(item, SPECULAR, material.specular, &STRENGTH)?;
        check(item, "its exponent", material.shininess, &STRENGTH)?;
    }
    Ok(())
}

/// Checks an object's transform and the rule for its normals.
pub(super) fn object(index: usize, object: &Object) -> Checked {
    let item = FrameItem::Object(index);
    if let NormalSource::Crease(degrees) = object.normals.source {
        check(item, "the crease angle of its normals", degrees, &CREASE)?;
    }
    let linear = object.transform.matrix3;
    let columns = [linear.x_axis, linear.y_axis, linear.z_axis];
    let names = [
        "the size that its transform gives to x",
        "the size that its transform gives to y",
        "the size that its transform gives to z",
    ];
    check_all(item, names, columns.map(direction::length), &SIZE)?;
    let name = "the volume that its transform leaves of a cube";
    check(item, name, volume(linear), &VOLUME)?;
    let names = [
        "x of its translation",
        "y of its translation",
        "z of its translation",
    ];
    let translation = object.transform.translation.to_array();
    check_all(item, names, translation, &COORDINATE)
}

/// Checks an object's vertex colours, which multiply its materials.
pub(super) fn colours(index: usize, object: &Object) -> Checked {
    let item = FrameItem::Object(index);
    let names = [
        "red of a vertex colour",
        "green of a vertex colour",
        "blue of a vertex colour",
    ];
    let mut colours = object.mesh.colours().iter();
    colours.try_for_each(|colour| check_all(item, names, colour.to_array(), &STRENGTH))
}

/// Checks where an object is in the world: the positions that its polygons use.
pub(super) fn positions(index: usize, object: &Object, model: &PlacedModel) -> Checked {
    // The object's bounds are known. Only if they reach too far, the positions are searched for the
    // culprit.
    let farthest = model.reach() + model.transform.translation.abs();
    if COORDINATE.holds_all(farthest) {
        return Ok(());
    }
    let item = FrameItem::Object(index);
    let names = [
        "x of a position in the world",
        "y of a position in the world",
        "z of a position in the world",
    ];
    let mut points = object.world_points();
    points.try_for_each(|point| check_all(item, names, point.to_array(), &COORDINATE))
}

/// Checks that no light of `scene` stands at a vertex of `objects`.
pub(super) fn lights_off_vertices(scene: &Scene, objects: &[Object]) -> Checked {
    let lights = scene.lights.iter().enumerate();
    let at = lights.filter_map(|(index, light)| match light.place {
        Place::Local(at) => Some((index, at)),
        Place::Infinite(_) => None,
    });
    for (light, at) in at {
        let mut points = objects.iter().flat_map(Object::world_points);
        if let Some(point) = points.find(|&point| stands_at(at, point, scene.camera.eye)) {
            let point = point.to_array();
            return Err(FrameError::LightAtVertex { light, point });
        }
    }
    Ok(())
}

/// Returns the light on material `material`, with unit vectors as directions.
///
/// # Errors
/// [`FrameError`] as for [`lighting`], and [`FrameError::Lights`] for more lights than allowed.
pub(crate) fn lit(lighting: &Lighting, material: usize) -> Result<Lighting, FrameError> {
    let found = lighting.lights.len();
    if found > Scene::MAX_LIGHTS {
        return Err(FrameError::Lights { found });
    }
    let mut lit = lighting.clone();
    make_unit(&mut lit);
    self::lighting(material, &lit)?;
    Ok(lit)
}

/// Turns the directions of the light on a material into unit vectors.
pub(super) fn make_unit(lighting: &mut Lighting) {
    let lights = lighting.lights.iter_mut().map(|light| &mut light.place);
    for place in lights.chain([&mut lighting.view]) {
        if let Place::Infinite(toward) = place {
            *toward = unit(*toward);
        }
    }
}

/// Checks the light on material `material`.
///
/// # Errors
/// [`FrameError::Value`] for the first value out of its range, and for a direction of length 0.
pub(super) fn lighting(material: usize, lighting: &Lighting) -> Checked {
    let item = FrameItem::Material(material);
    check_all(item, AMBIENT, lighting.ambient, &STRENGTH)?;
    check(item, "its exponent", lighting.shininess, &STRENGTH)?;
    let names = [
        "x of the direction toward the eye",
        "y of the direction toward the eye",
        "z of the direction toward the eye",
        "the length of the direction toward the eye",
    ];
    let at = ["x of the eye", "y of the eye", "z of the eye"];
    place(item, lighting.view, names, at)?;
    let mut lights = lighting.lights.iter().enumerate();
    lights.try_for_each(|(light, term)| light_on(FrameItem::LightOn { light, material }, term))
}

fn light_on(item: FrameItem, light: &LightTerm) -> Checked {
    place(item, light.place, DIRECTION, POSITION)?;
    check_all(item, DIFFUSE, light.diffuse, &STRENGTH)?;
    check_all(item, SPECULAR, light.specular, &STRENGTH)?;
    falloff(item, light.falloff)
}

fn place(
    item: FrameItem,
    place: Place<[f32; 3]>,
    toward: [&'static str; 4],
    at: [&'static str; 3],
) -> Checked {
    match place {
        Place::Infinite(vector) => direction(item, toward, vector),
        Place::Local(point) => check_all(item, at, point, &DISTANCE),
    }
}
