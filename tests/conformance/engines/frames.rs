//! Frames of every kind for which engines have a separate path.

use fastphong::frame::Frame;
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::picture::Encoding;
use fastphong::scene::{
    Clipping, DepthBits, DepthBuffer, DepthSource, Falloff, HiddenSurfaces, Interpolation, Light,
    PainterKey, Projection, Scene, SpecularModel,
};
use glam::{DAffine3, DVec3};

/// Builds a near view of two balls, `width` × `height` pixels. They have different materials, one
/// is of n-gons and one of triangles, and one is partly behind the other.
fn scene(width: u32, height: u32) -> Scene {
    let mut scene =
        Scene::of_mesh(builtin("sphere?rings=12&segments=24").expect("a built-in mesh"));
    (scene.width, scene.height, scene.background) = (width, height, [0.1, 0.2, 0.3]);
    scene.camera.projection = Projection::Perspective { fovy: 50.0 };
    scene.camera.eye = scene.camera.target + scene.camera.view() * 3.0;
    (scene.camera.near, scene.camera.far) = (0.5, 8.0);
    scene.lights = lights(1);
    let mut second = scene.objects[0].clone();
    second.mesh = builtin("sphere?rings=8&segments=12&triangles=true")
        .expect("a built-in mesh")
        .into();
    second.transform = DAffine3::from_translation(DVec3::new(0.7, 0.4, -0.3));
    second.material = Some(Material {
        diffuse: [0.2, 0.7, 0.3],
        shininess: 7.5,
        ..Material::default()
    });
    scene.objects.push(second);
    scene
}

/// Returns lights from different directions whose total brightness is that of a single light.
fn lights(count: usize) -> Vec<Light> {
    let light = |i: usize| {
        let angle = 2.399963 * i as f64; // the golden angle
        let direction = DVec3::new(0.7 * angle.cos(), 0.7 * angle.sin(), 1.0).normalize();
        Light::directional(direction, [0.9, 0.7, 0.5].map(|c| c / count as f32))
    };
    (0..count).map(light).collect()
}

fn near_light(scene: &mut Scene, falloff: Falloff) {
    let place = scene.camera.eye + DVec3::new(2.0, 1.5, 0.5);
    scene.lights = vec![Light::positional(place, [0.8, 0.7, 0.6]).with_falloff(falloff)];
    scene.local_viewer = true;
}

fn buffer(bits: DepthBits, source: DepthSource) -> HiddenSurfaces {
    HiddenSurfaces::ZBuffer(DepthBuffer { bits, source })
}

/// A kind of frame: its name, and the change that makes the scene one.
type Kind = (&'static str, fn(&mut Scene));

const KINDS: [Kind; 21] = [
    ("one material", |scene| scene.objects.truncate(1)),
    ("two materials", |_| ()),
    ("triangles", |scene| drop(scene.objects.remove(0))),
    ("two lights", |scene| scene.lights = lights(2)),
    ("four lights", |scene| scene.lights = lights(4)),
    ("more lights than groups take", |scene| {
        scene.lights = lights(6)
    }),
    ("no light", |scene| scene.lights.clear()),
    ("halfway vectors", |scene| {
        scene.specular = SpecularModel::Blinn
    }),
    ("sharp halfway vectors", |scene| {
        scene.specular = SpecularModel::Blinn;
        scene.objects[0].material = Some(Material {
            shininess: 120.0,
            ..Material::default()
        });
    }),
    ("a light and the eye near", |scene| {
        near_light(scene, Falloff::None)
    }),
    ("a light that falls off", |scene| {
        near_light(scene, Falloff::Attenuation(0.2))
    }),
    ("parallel rays", |scene| {
        scene.camera.projection = Projection::Orthographic { half_height: 1.4 }
    }),
    ("perspective", |scene| {
        scene.interpolation = Interpolation::Perspective
    }),
    ("perspective, a light near, clipped", |scene| {
        near_light(scene, Falloff::None);
        (scene.interpolation, scene.camera.near) = (Interpolation::Perspective, 2.1);
    }),
    ("painter", |scene| {
        scene.hidden_surfaces = HiddenSurfaces::Painter(PainterKey::default())
    }),
    ("in the order of drawing", |scene| {
        scene.hidden_surfaces = HiddenSurfaces::DrawOrder
    }),
    ("a depth buffer of 16 bits", |scene| {
        scene.hidden_surfaces = buffer(DepthBits::Sixteen, DepthSource::Interpolated);
    }),
    ("depth per sample", |scene| {
        scene.hidden_surfaces = buffer(DepthBits::ThirtyTwo, DepthSource::PerSample)
    }),
    ("clipped in the cube", |scene| {
        (scene.clipping, scene.camera.near) = (Clipping::NdcCube, 2.1)
    }),
    ("four samples per pixel", |scene| scene.samples = 2),
    ("sRGB", |scene| scene.encoding = Encoding::Srgb),
];

/// Returns one frame of each kind.
pub fn kinds(width: u32, height: u32) -> impl Iterator<Item = (&'static str, Frame)> {
    KINDS.into_iter().map(move |(name, change)| {
        let mut scene = scene(width, height);
        change(&mut scene);
        (name, scene.frame().expect("a frame"))
    })
}

/// Returns three frames of each kind, seen by the same camera: with both balls, with only the
/// first, and with only the second.
pub fn parts(width: u32, height: u32) -> impl Iterator<Item = (&'static str, Frame, [Frame; 2])> {
    KINDS.into_iter().filter_map(move |(name, change)| {
        let mut both = scene(width, height);
        change(&mut both);
        let [first, second] = &both.objects[..] else {
            return None;
        };
        let alone = [first, second].map(|object| {
            let mut scene = both.clone();
            scene.objects = vec![object.clone()];
            scene.frame().expect("a frame")
        });
        Some((name, both.frame().expect("a frame"), alone))
    })
}
