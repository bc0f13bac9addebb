//! CS171's red sphere under two coloured lights, by its three algorithms; the highlight that Algorithm 7 loses as it is
//! printed; and the test against the NDC cube, which is not clipping.

use super::stage::written;
use super::{Agreement, Content, Figure, FigureError, Finding, Shown};
use crate::frame::Frame;
use crate::frame::triangulate::triangulated;
use crate::mesh::builtin::builtin;
use crate::mesh::vertex_normals::NormalSource;
use crate::mesh::{Material, MeshBuilder};
use crate::picture::{Picture, Picture8};
use crate::reference::cs171::{
    Raster, Reading, Shading, TriangleCorner, full_shading, render, world_to_ndc,
};
use crate::scene::{
    Camera, Culling, Light, Lighting, Object, Projection, Scene, SpecularGate, SpecularModel,
};
use alloc::format;
use alloc::sync::Arc;
use glam::{DAffine3, DVec3};

pub(super) static FIGURE: Figure = Figure {
    name: "cs171",
    title: "CS171's algorithms as printed",
    lecture: "CS171 3, Figures 9 to 11; CS171 4 and 5",
    make,
};

/// Width and height of the pictures.
const SIDE: u32 = 96;

/// A picture in `f64` in eight bits.
fn eight_bits(picture: &Picture<[f64; 4]>) -> Picture8 {
    picture.map(|texel| texel.map(|c| libm::round(255.0 * c) as u8))
}

/// A red sphere under a yellow and a blue light at positions, lit as CS171 does it.
fn sphere() -> Result<Frame, FigureError> {
    let mut scene = Scene::of_mesh(builtin("sphere?rings=8&segments=14")?);
    (scene.width, scene.height) = (SIDE, SIDE);
    (scene.specular, scene.shininess_for) = (SpecularModel::Blinn, SpecularModel::Blinn);
    scene.gate = SpecularGate::Ungated;
    scene.local_viewer = true;
    scene.ambient = [1.0; 3];
    let material = Material {
        ambient: [0.06, 0.01, 0.01],
        diffuse: [0.7, 0.08, 0.06],
        specular: [0.5; 3],
        shininess: 60.0,
    };
    for object in &mut scene.objects {
        object.material = Some(material);
    }
    let axes = scene.camera.axes();
    let at = |right: f64, up: f64, toward: f64| axes[0] * right + axes[1] * up - axes[2] * toward;
    scene.lights = [
        Light::positional(at(3.0, 2.5, 3.5), [1.0, 0.9, 0.4]),
        Light::positional(at(-4.0, -0.5, 2.5), [0.25, 0.45, 1.0]),
    ]
    .into();
    Ok(triangulated(&scene.frame()?).frame)
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let frame = sphere()?;
    let unit = Reading::default();
    let draw = |shading, reading| render(&frame, shading, reading).colours;
    let (flat, gouraud, phong) = (
        draw(Shading::Flat, unit),
        draw(Shading::Gouraud, unit),
        draw(Shading::Phong, unit),
    );
    let raw = draw(
        Shading::Phong,
        Reading {
            normalise: false,
            ..unit
        },
    );
    content.text(
        "A red sphere, a yellow and a blue light at positions, all by Algorithm 8: once a triangle (Figure 10), once a \
         vertex (Figure 9), once a pixel (Figure 11). The last picture is Algorithm 7 as it is printed: the interpolated \
         normal goes to the lighting model as it is, though that asks for a unit normal.",
    );
    let shown = |caption: &str, picture: &Picture<[f64; 4]>| {
        Shown::new(
            caption,
            format!("A red sphere under two coloured lights, {caption}."),
            eight_bits(picture),
        )
    };
    content.pictures(
        4,
        [
            shown("flat (Algorithm 6)", &flat),
            shown("Gouraud (Algorithm 4)", &gouraud),
            shown("Phong (Algorithm 7)", &phong),
            shown("Algorithm 7 as printed", &raw),
        ]
        .into(),
    );
    highlights(&mut content, [&gouraud, &phong, &raw]);
    cube(&mut content)?;
    Ok(content)
}

/// How bright the highlights are: the green light, of which the sphere's own colour has nearly none.
fn highlights(content: &mut Content, pictures: [&Picture<[f64; 4]>; 3]) {
    let green = |picture: &Picture<[f64; 4]>, i: usize| 255.0 * picture.texels()[i][1];
    let count = pictures[0].texels().len();
    let [gouraud, phong, raw] =
        pictures.map(|p| (0..count).fold(0.0f64, |peak, i| peak.max(green(p, i))));
    let lost = (0..count).fold(0.0f64, |lost, i| {
        lost.max(green(pictures[1], i) - green(pictures[2], i))
    });
    let (label, all) = ("brightest pixel of the highlight, its green", "levels");
    content.adds(
        "peak-phong",
        format!("{label}, Algorithm 7 with unit normals"),
        (phong, all),
        "What the others are measured against.",
    );
    let is_blurred = gouraud < phong - 1.0;
    content.claim("peak-gouraud", format!("{label}, Algorithm 4"), (gouraud, all), is_blurred, ["Between vertices the highlight is cut off: \"a bit pixelated\", where Phong's is smooth.", "The highlight is as bright as Phong's."]);
    content.adds("peak-printed", format!("{label}, Algorithm 7 as printed"), (raw, all), format!(
            "Shorter normals have smaller cosines, and the power makes little of them: {} levels less where it is most.",
            written(lost)
        ));
    content.claim(
        "lost",
        "most that a pixel loses by normals that are not made unit vectors",
        (lost, all),
        lost < 1.0,
        [
            "Interpolated normals can be used as they are.",
            "The lighting model asks for unit normals: make them so at each pixel.",
        ],
    );
}

/// A floor under the eye, from in front of it to `behind`.
fn floor(behind: f64) -> [DVec3; 4] {
    [(-2.0, -9.0), (-2.0, behind), (2.0, behind), (2.0, -9.0)].map(|(x, z)| DVec3::new(x, -1.0, z))
}

/// The floor drawn with the cube alone, as printed, and clipped.
fn floors(behind: f64) -> Result<[Picture<[f64; 4]>; 2], FigureError> {
    let camera = Camera {
        eye: DVec3::ZERO,
        target: -DVec3::Z,
        up: DVec3::Y,
        projection: Projection::Perspective { fovy: 90.0 },
        near: 1.5,
        far: 20.0,
    };
    let material = Material {
        ambient: [0.2, 0.6, 0.3],
        ..Material::default()
    };
    let corners = floor(behind);
    let light = Lighting::new(&material, [1.0; 3], &[], DVec3::Z);
    let matrix = camera.clip_matrix(1.0);
    let [a, b, c, d] = corners.map(|v| TriangleCorner {
        world: v,
        normal: DVec3::Y,
        ndc: world_to_ndc(&matrix, v),
        inv_w: 1.0,
    });
    let mut grid = Raster::new(SIDE as usize, SIDE as usize, DVec3::ZERO);
    for triangle in [[a, b, c], [a, c, d]] {
        let reading = Reading {
            cull: false,
            ..Reading::default()
        };
        full_shading(Shading::Flat, &triangle, &light, reading, &mut grid);
    }
    let mut builder = MeshBuilder::new(corners.map(DVec3::as_vec3).to_vec());
    builder.polygon(&[0, 1, 2, 3]);
    let object = Object {
        mesh: Arc::new(builder.finish()?),
        transform: DAffine3::IDENTITY,
        material: Some(material),
        normals: NormalSource::Averaged,
    };
    let scene = Scene {
        width: SIDE,
        height: SIDE,
        culling: Culling::None,
        objects: [object].into(),
        ..Scene::new(camera)
    };
    let clipped = render(
        &triangulated(&scene.frame()?).frame,
        Shading::Flat,
        Reading {
            cull: false,
            ..Reading::default()
        },
    );
    Ok([grid.colours, clipped.colours])
}

/// How many pixels one has and the other has not.
fn only(a: &Picture<[f64; 4]>, b: &Picture<[f64; 4]>) -> usize {
    a.texels()
        .iter()
        .zip(b.texels())
        .filter(|(a, b)| a[3] > b[3])
        .count()
}

/// The test against the cube at each pixel, and clipping.
fn cube(content: &mut Content) -> Result<(), FigureError> {
    let [near, near_clipped] = floors(-1.0)?;
    let [behind, behind_clipped] = floors(2.0)?;
    content.text(
        "The test against the NDC cube. On the left a floor that ends before the near plane, but in front of the eye: what \
         is cut off at each pixel is what clipping cuts off. On the right the floor goes on behind the eye. Its corners \
         there are divided by a negative depth and stand above the horizon: no test at a pixel puts that right, and clipping \
         must come first.",
    );
    let shown = |caption: &str, picture: &Picture<[f64; 4]>| {
        Shown::new(
            caption,
            format!("A floor to the horizon: {caption}."),
            eight_bits(picture),
        )
    };
    content.pictures(
        4,
        [
            shown("up to the near plane, cube", &near),
            shown("the same, clipped", &near_clipped),
            shown("behind the eye, cube", &behind),
            shown("the same, clipped", &behind_clipped),
        ]
        .into(),
    );
    let same = only(&near, &near_clipped) + only(&near_clipped, &near);
    // Clipping makes corners, which are snapped to 1/256 pixel: a pixel of the rim may fall to either side.
    let holds = same <= SIDE as usize;
    content.claim(
        "cube-in-front",
        "pixels in which the cube's test and clipping differ, all corners in front of the eye",
        (same as f64, "pixels"),
        holds,
        [
            "\"Parts within the cube\" are rendered, as the notes say.",
            "The test is not clipping.",
        ],
    );
    let (missing, extra) = (
        only(&behind_clipped, &behind),
        only(&behind, &behind_clipped),
    );
    for (key, label, count) in [
        (
            "cube-missing",
            "pixels that the cube's test loses, corners behind the eye",
            missing,
        ),
        ("cube-extra", "pixels that it draws where nothing is", extra),
    ] {
        let holds = count == 0;
        let verdict = if holds {
            "The cube's test is enough."
        } else {
            "The cube's test is no clipping: corners behind the eye have no place."
        };
        content.found(Finding::new(
            key,
            label,
            (count as f64, "pixels"),
            Agreement::if_holds(holds),
            verdict,
        ));
    }
    Ok(())
}
