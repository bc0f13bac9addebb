//! CS171's red sphere under two coloured lights, drawn by its three algorithms; the highlight that
//! Algorithm 7 as printed loses; and the test against the NDC cube, which does not replace
//! clipping.

use super::prelude::*;
use fastphong::frame::triangulate::triangulated;
use fastphong::picture::{Picture, Picture8};
use fastphong::reference::cs171::{
    Raster, Reading, Shading, TriangleCorner, full_shading, render, world_to_ndc,
};

pub(super) static FIGURE: Figure = Figure {
    name: "cs171",
    title: "CS171's algorithms as printed",
    lecture: "CS171 3, Figures 9 to 11; CS171 4 and 5",
    parts: &[highlights, cube],
    live: None,
};

/// Width and height of the pictures.
const SIDE: u32 = 96;

/// A picture in `f64`, which the notes' algorithms draw.
type F64Picture = Picture<[f64; 4]>;

fn eight_bits(picture: &F64Picture) -> Picture8 {
    picture.map(|pixel| pixel.map(|c| libm::round(255.0 * c) as u8))
}

/// Makes a red sphere under a yellow and a blue light at positions, with CS171's lighting.
fn sphere() -> Result<Frame> {
    let mut scene = fitted("sphere?rings=8&segments=14", [SIDE; 2])?;
    (scene.specular, scene.shininess_for) = (SpecularModel::Blinn, SpecularModel::Blinn);
    scene.gate = SpecularGate::Ungated;
    scene.local_viewer = true;
    scene.ambient = [1.0; 3];
    scene.objects[0].material = Some(Material {
        ambient: [0.06, 0.01, 0.01],
        diffuse: [0.7, 0.08, 0.06],
        specular: [0.5; 3],
        shininess: 60.0,
    });
    let [right, up, forward] = scene.camera.axes();
    let at = |r: f64, u: f64, toward: f64| right * r + up * u - forward * toward;
    scene.lights = vec![
        Light::positional(at(3.0, 2.5, 3.5), [1.0, 0.9, 0.4]),
        Light::positional(at(-4.0, -0.5, 2.5), [0.25, 0.45, 1.0]),
    ];
    Ok(triangulated(&scene.frame()?).frame)
}

/// Measures the highlights in the green channel, because the sphere's own colour has almost no
/// green.
fn highlights(content: &mut FigureContent) -> Result {
    content.text(
        "A red sphere under two lights at positions. Algorithm 8 lights it once per triangle (Figure \
         10), once per vertex (Figure 9) or once per pixel (Figure 11). Algorithm 7 as printed does \
         not normalise the interpolated normal, although the lighting model asks for a unit normal.",
    );
    let frame = sphere()?;
    let unit = Reading::default();
    let draw = |shading, reading| render(&frame, shading, reading).colours;
    let flat = draw(Shading::Flat, unit);
    let gouraud = draw(Shading::Gouraud, unit);
    let phong = draw(Shading::Phong, unit);
    let as_printed = Reading {
        normalise: false,
        ..unit
    };
    let raw = draw(Shading::Phong, as_printed);
    content.row(
        "A red sphere under two coloured lights",
        "flat (Algorithm 6) | Gouraud (Algorithm 4) | Phong (Algorithm 7) | Algorithm 7 as printed",
        [&flat, &gouraud, &phong, &raw].map(eight_bits),
    );
    let green = [&gouraud, &phong, &raw].map(|p| p.pixels().iter().map(|pixel| 255.0 * pixel[1]));
    let [gouraud, phong, raw] = green.clone().map(largest);
    let [_, with_unit, as_printed] = green;
    let lost = largest(with_unit.zip(as_printed).map(|(unit, raw)| unit - raw));
    content.adds(
        "peak-phong | brightest pixel of the highlight, its green, Algorithm 7 with unit normals",
        (phong, "levels", true),
        "The other methods are measured against this one.",
    );
    content.confirms(
        "peak-gouraud | brightest pixel of the highlight, its green, Algorithm 4",
        (gouraud, "levels", gouraud < phong - 1.0),
        "The highlight is cut off between vertices: \"a bit pixelated\". Phong's is smooth.",
    );
    content.adds(
        "peak-printed | brightest pixel of the highlight, its green, Algorithm 7 as printed",
        (raw, "levels", true),
        &format!(
            "Shorter normals have smaller cosines and smaller powers: up to {} levels less.",
            written(lost)
        ),
    );
    content.contradicts(
        "lost | largest loss at a pixel without normalising",
        (lost, "levels", lost >= 1.0),
        "The lighting model asks for unit normals: normalise at each pixel.",
    );
    Ok(())
}

/// Draws a floor below the eye, which reaches from in front of it to z = `behind`: first with only
/// the cube's test, as printed, then clipped.
fn floors(behind: f64) -> Result<[F64Picture; 2]> {
    let projection = Projection::Perspective { fovy: 90.0 };
    let mut camera = Camera::looking_at(DVec3::ZERO, -DVec3::Z, projection);
    (camera.near, camera.far) = (1.5, 20.0);
    let material = Material {
        ambient: [0.2, 0.6, 0.3],
        ..Material::default()
    };
    let reading = Reading {
        cull: false,
        ..Reading::default()
    };
    let corners = [(-2.0, -9.0), (-2.0, behind), (2.0, behind), (2.0, -9.0)]
        .map(|(x, z)| DVec3::new(x, -1.0, z));

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
        full_shading(Shading::Flat, &triangle, &light, reading, &mut grid);
    }

    let mut scene = bare(&corners, &[&[0, 1, 2, 3]], camera, [SIDE; 2])?;
    scene.objects[0].material = Some(material);
    let clipped = triangulated(&scene.frame()?).frame;
    let clipped = render(&clipped, Shading::Flat, reading);
    Ok([grid.colours, clipped.colours])
}

/// Counts the pixels that `a` covers and `b` does not.
fn only(a: &F64Picture, b: &F64Picture) -> usize {
    let pairs = a.pixels().iter().zip(b.pixels());
    pairs.filter(|(a, b)| a[3] > b[3]).count()
}

/// Compares clipping with a test of each pixel against the cube.
fn cube(content: &mut FigureContent) -> Result {
    let [near, near_clipped] = floors(-1.0)?;
    let [behind, behind_clipped] = floors(2.0)?;
    content.text(
        "Each pixel is tested against the NDC cube. Where the whole floor is in front of the eye, this \
         cuts off as much as clipping. A corner behind the eye is divided by a negative depth, which \
         puts it above the horizon: clipping must come first.",
    );
    content.row(
        "A floor to the horizon",
        "up to the near plane, cube | up to the near plane, clipped | behind the eye, cube | \
         behind the eye, clipped",
        [&near, &near_clipped, &behind, &behind_clipped].map(eight_bits),
    );
    let differing = only(&near, &near_clipped) + only(&near_clipped, &near);
    // Clipping adds corners, which are snapped to 1/256 pixel, so that a pixel on the rim may fall
    // to either side.
    content.confirms(
        "cube-in-front | pixels where the cube's test and clipping differ, all corners in front of the \
         eye",
        (differing as f64, "pixels", differing <= SIDE as usize),
        "\"Parts within the cube\" are rendered, as the notes say.",
    );
    let missing = only(&behind_clipped, &behind);
    content.contradicts(
        "cube-missing | pixels that the cube's test loses, corners behind the eye",
        (missing as f64, "pixels", missing != 0),
        "The cube's test does not replace clipping: corners behind the eye have no place on the picture.",
    );
    let extra = only(&behind, &behind_clipped);
    content.contradicts(
        "cube-extra | pixels that it draws where there is no floor",
        (extra as f64, "pixels", extra != 0),
        "The cube's test draws a part of the floor above the horizon.",
    );
    Ok(())
}
