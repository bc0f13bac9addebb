//! Hidden surfaces by the painter's algorithm and by a depth buffer (L5).

use super::prelude::*;
use fastphong::raster::painter_conflicts::conflicts;
use fastphong::scene::{DepthBuffer, HiddenSurfaces, PainterKey};

pub(super) static FIGURE: Figure = Figure {
    name: "painter",
    title: "The painter's algorithm: rings, and polygons that cut each other",
    lecture: "L5, Painter's Algorithm, Z-Buffer",
    parts: &[ring, cutting, order],
    live: None,
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

/// A scene of three objects, and its picture by the depth buffer.
struct ThreeObjects {
    scene: Scene,
    by_depth: LinearPicture,
}

impl ThreeObjects {
    fn new(name: &str) -> Result<ThreeObjects> {
        let scene = shipped(name, SIZE)?;
        let by_depth = drawn(&scene, depth_buffer())?;
        Ok(ThreeObjects { scene, by_depth })
    }

    /// Shows the pictures by depth buffer and by painter side by side. Returns how many pixels
    /// differ.
    fn by_both(&self, content: &mut FigureContent, what: &str) -> Result<usize> {
        let by_painter = drawn(&self.scene, HiddenSurfaces::Painter(PainterKey::Mean))?;
        let captions = format!("{what}: depth buffer | {what}: painter");
        let pictures = [&self.by_depth, &by_painter].map(stored);
        content.row("Hidden surfaces", &captions, pictures);
        Ok(differing(&self.by_depth, &by_painter))
    }

    /// Counts the pixels that differ from the depth buffer's picture, for each order of drawing.
    fn by_orders(&self, hidden_surfaces: HiddenSurfaces) -> Result<Vec<usize>> {
        let by_order = |order: [usize; 3]| {
            let mut scene = self.scene.clone();
            scene.objects = order.map(|i| self.scene.objects[i].clone()).into();
            Ok(differing(&self.by_depth, &drawn(&scene, hidden_surfaces)?))
        };
        ORDERS.into_iter().map(by_order).collect()
    }
}

fn depth_buffer() -> HiddenSurfaces {
    HiddenSurfaces::ZBuffer(DepthBuffer::default())
}

fn drawn(scene: &Scene, hidden_surfaces: HiddenSurfaces) -> Result<LinearPicture> {
    let mut scene = scene.clone();
    scene.hidden_surfaces = hidden_surfaces;
    draw(&scene.frame()?, "naive-phong")
}

fn ring(content: &mut FigureContent) -> Result {
    content.text(
        "The painter draws from back to front, here sorted by the mean depth of each polygon's corners. A \
         depth buffer decides at each pixel. Both draw three triangles that hide each other in a ring, \
         and polygons that cut each other.",
    );
    let ring = ThreeObjects::new("cyclic-triangles")?;
    let wrong = ring.by_both(content, "three triangles in a ring")?;
    content.confirms(
        "ring-wrong | pixels of the ring that the painter draws wrongly",
        (wrong as f64, "pixels", wrong > 0),
        "The painter cannot draw the ring.",
    );
    let orders = ring.by_orders(HiddenSurfaces::DrawOrder)?;
    let least = orders.into_iter().min().unwrap_or(0);
    content.confirms(
        "ring-best-order | wrong pixels in the best of all six orders",
        (least as f64, "pixels", least > 0),
        "No order is right: all six were tried.",
    );
    let cycles = conflicts(&ring.scene.frame()?).cycles;
    let (rings, members) = (cycles.len(), cycles.iter().map(Vec::len).sum::<usize>());
    content.adds(
        "ring-cycle | polygons found to hide each other in a ring",
        (members as f64, "polygons", true),
        &format!("The program warns of {rings} ring before it draws."),
    );
    Ok(())
}

fn cutting(content: &mut FigureContent) -> Result {
    let cutting = ThreeObjects::new("interpenetration")?;
    let wrong = cutting.by_both(content, "polygons that cut each other")?;
    content.confirms(
        "cutting-wrong | polygons that cut each other: pixels that the painter draws wrongly",
        (wrong as f64, "pixels", wrong > 0),
        "Only the depth buffer shows where the polygons meet.",
    );
    let pairs = conflicts(&cutting.scene.frame()?).interpenetrating;
    content.adds(
        "cutting-pairs | pairs of polygons that cut each other on the picture",
        (pairs as f64, "pairs", true),
        "Each polygon of a pair hides a part of the other, so either order is wrong.",
    );
    Ok(())
}

fn order(content: &mut FigureContent) -> Result {
    let mut most = 0;
    for name in ["cyclic-triangles", "interpenetration"] {
        let orders = ThreeObjects::new(name)?.by_orders(depth_buffer())?;
        most = most.max(orders.into_iter().max().unwrap_or(0));
    }
    content.confirms(
        "order | pixels that change in the depth buffer's pictures, in the worst of six orders",
        (most as f64, "pixels", most == 0),
        "To a depth buffer the order of drawing does not matter.",
    );
    Ok(())
}
