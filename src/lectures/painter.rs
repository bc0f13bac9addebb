//! What is hidden: by the painter's algorithm, and by a depth buffer (L5).

use super::stage::{differing, shipped, stored};
use super::{Content, Figure, FigureError, Shown};
use crate::picture::LinearPicture;
use crate::raster::painter::conflicts;
use crate::scene::{DepthBuffer, HiddenSurfaces, PainterKey, Scene};
use crate::shading::Variant;
use alloc::format;
use alloc::vec::Vec;

pub(super) static FIGURE: Figure = Figure {
    name: "painter",
    title: "The painter's algorithm, the ring that it cannot draw, and polygons that cut each other",
    lecture: "L5, Painter's Algorithm, Z-Buffer",
    make,
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [160, 120];

/// All orders of three objects.
const ORDERS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
];

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.text(
        "The painter draws from back to front, here by the mean depth of each polygon's corners, and what comes later \
         covers what was there. A depth buffer decides at each pixel. Three triangles in a ring, and three polygons that cut \
         each other, by both.",
    );
    ring(&mut content)?;
    cutting(&mut content)?;
    order(&mut content)?;
    Ok(content)
}

fn drawn(scene: &Scene, hidden_surfaces: HiddenSurfaces) -> Result<LinearPicture, FigureError> {
    let scene = Scene {
        hidden_surfaces,
        ..scene.clone()
    };
    Ok(Variant::parse("naive-phong")?.render_linear(&scene.frame()?))
}

/// The objects of a scene in another order.
fn reordered(scene: &Scene, order: [usize; 3]) -> Scene {
    Scene {
        objects: order
            .iter()
            .filter_map(|&i| scene.objects.get(i).cloned())
            .collect(),
        ..scene.clone()
    }
}

/// A scene by depth buffer and by painter, side by side; the pixels that differ.
fn by_both(content: &mut Content, scene: &Scene, what: &str) -> Result<usize, FigureError> {
    let by_depth = drawn(scene, HiddenSurfaces::ZBuffer(DepthBuffer::default()))?;
    let by_painter = drawn(scene, HiddenSurfaces::Painter(PainterKey::Mean))?;
    let wrong = differing(&by_depth, &by_painter);
    let shown = |how: &str, picture: &LinearPicture| {
        Shown::new(
            format!("{what}: {how}"),
            format!("{what}, by {how}."),
            stored(picture),
        )
    };
    content.pictures(
        2,
        [
            shown("depth buffer", &by_depth),
            shown("painter", &by_painter),
        ]
        .into(),
    );
    Ok(wrong)
}

fn ring(content: &mut Content) -> Result<(), FigureError> {
    let scene = shipped("cyclic-triangles", SIZE)?;
    let wrong = by_both(content, &scene, "three triangles in a ring")?;
    content.claim(
        "ring-wrong",
        "pixels of the ring that the painter draws wrongly",
        (wrong as f64, "pixels"),
        wrong > 0,
        [
            "The painter cannot draw the ring.",
            "The painter draws the ring right.",
        ],
    );
    let by_depth = drawn(&scene, HiddenSurfaces::ZBuffer(DepthBuffer::default()))?;
    let mut least = usize::MAX;
    for order in ORDERS {
        let by_order = drawn(&reordered(&scene, order), HiddenSurfaces::DrawOrder)?;
        least = least.min(differing(&by_depth, &by_order));
    }
    content.claim(
        "ring-best-order",
        "wrong pixels in the best of all six orders",
        (least as f64, "pixels"),
        least > 0,
        [
            "No order is right, all were tried.",
            "There is an order that is right.",
        ],
    );
    let cycles = conflicts(&scene.frame()?).cycles;
    let members: usize = cycles.iter().map(Vec::len).sum();
    content.adds(
        "ring-cycle",
        "polygons that are found to hide each other in a ring",
        (members as f64, "polygons"),
        format!(
            "The program finds {} such ring before it draws, and says so.",
            cycles.len()
        ),
    );
    Ok(())
}

fn cutting(content: &mut Content) -> Result<(), FigureError> {
    let scene = shipped("interpenetration", SIZE)?;
    let wrong = by_both(content, &scene, "polygons that cut each other")?;
    content.claim(
        "cutting-wrong",
        "pixels of polygons that cut each other which the painter draws wrongly",
        (wrong as f64, "pixels"),
        wrong > 0,
        [
            "Only the depth buffer shows where they meet.",
            "The painter shows where they meet.",
        ],
    );
    let pairs = conflicts(&scene.frame()?).interpenetrating;
    content.adds(
        "cutting-pairs",
        "pairs of polygons that cut each other on the picture",
        (pairs as f64, "pairs"),
        "Each hides a part of the other, so that either order is wrong.",
    );
    Ok(())
}

fn order(content: &mut Content) -> Result<(), FigureError> {
    let depth = HiddenSurfaces::ZBuffer(DepthBuffer::default());
    let mut most = 0;
    for name in ["cyclic-triangles", "interpenetration"] {
        let scene = shipped(name, SIZE)?;
        let first = drawn(&scene, depth)?;
        for order in ORDERS {
            most = most.max(differing(&first, &drawn(&reordered(&scene, order), depth)?));
        }
    }
    content.claim(
        "order",
        "most pixels by which the depth buffer's pictures differ in any of six orders",
        (most as f64, "pixels"),
        most == 0,
        [
            "The order of drawing does not matter to a depth buffer.",
            "The order of drawing matters.",
        ],
    );
    Ok(())
}
