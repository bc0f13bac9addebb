//! The viewer: draws a scene from a moving camera, and redraws only what has changed.

use super::{Action, Panes, Side, Times};
use fastphong::frame::{Frame, FrameError, PreparedScene};
use fastphong::picture::{Alpha, PictureMut};
use fastphong::raster::{DrawError, DrawOptions, Renderer};
use fastphong::scene::orbit::{Orbit, Start};
use fastphong::scene::{Light, Scene};
use fastphong::shading::Variant;
use std::format;
use std::string::String;
use std::time::Instant;
use std::vec::Vec;

/// A scene that is ready to be drawn from anywhere.
#[derive(Clone, Debug)]
pub struct Loaded {
    prepared: PreparedScene,
    start: Start,
    lights: Vec<Light>,
    /// The size that the scene asks for.
    size: [u32; 2],
    /// The longest side of a picture, in pixels. Supersampling makes it shorter.
    most: usize,
}

impl Loaded {
    /// Prepares `scene`. `given` is true for the near plane, and for the far plane, if it must stay
    /// where it is.
    ///
    /// # Errors
    /// As [`Scene::prepare`].
    pub fn new(scene: &Scene, given: [bool; 2]) -> Result<Loaded, FrameError> {
        Ok(Loaded {
            prepared: scene.prepare()?,
            start: Start::new(scene, given),
            lights: scene.lights.clone(),
            size: [scene.width, scene.height],
            most: (Scene::MAX_SIDE / scene.samples) as usize,
        })
    }

    /// Returns the frame of the scene's own camera.
    ///
    /// # Errors
    /// As [`Scene::frame`].
    pub fn frame(&self) -> Result<Frame, FrameError> {
        self.prepared.frame()
    }
}

/// The picture of one side, kept as long as it is valid.
#[derive(Debug, Default)]
struct Kept {
    pixels: Vec<u32>,
    /// The generation of the frame that the pixels show; `None` if they are not valid.
    frame: Option<u64>,
    /// The index of the method that drew the pixels.
    method: Option<usize>,
    /// The drawing times of this method.
    times: Times,
    /// The reason if the method cannot draw this scene.
    refused: Option<DrawError>,
}

/// A loaded scene with the state of its window.
#[derive(Debug)]
pub struct Viewer {
    loaded: Loaded,
    name: String,
    renderer: Renderer,
    /// The methods and the divider.
    pub panes: Panes,
    orbit: Orbit,
    carries_lights: bool,
    frame: Frame,
    /// The generation of the frame: 1 for the first, one more for each further one.
    generation: u64,
    /// True if camera, size, lights or scene have changed since the frame was projected.
    is_stale: bool,
    size: [usize; 2],
    kept: [Kept; 2],
    projecting: Times,
}

/// The dark grey that fills a pane if its method cannot draw.
const NO_PICTURE: u32 = 0xff30_3030;

impl Viewer {
    /// Makes a viewer of a loaded scene. `name` appears in the title.
    ///
    /// # Errors
    /// As [`Scene::frame`].
    pub fn new(
        loaded: Loaded,
        name: &str,
        panes: Panes,
        renderer: Renderer,
    ) -> Result<Viewer, FrameError> {
        let mut frame = loaded.frame()?;
        // A window has no alpha channel, so edges must be blended with the background here.
        frame.set_alpha(Alpha::Flattened);
        Ok(Viewer {
            size: loaded.size.map(|side| side as usize),
            loaded,
            name: name.into(),
            renderer,
            panes,
            orbit: Orbit::default(),
            carries_lights: false,
            frame,
            generation: 0,
            is_stale: true,
            kept: Default::default(),
            projecting: Times::default(),
        })
    }

    /// Returns the width and height that the scene asks for.
    pub fn wanted_size(&self) -> [u32; 2] {
        self.loaded.size
    }

    /// Shows another scene, or a changed one, from the current camera.
    pub fn replace(&mut self, loaded: Loaded) {
        self.loaded = loaded;
        self.forget_times();
        self.is_stale = true;
    }

    /// Performs an action, with the pointer on `side`. Returns false for [`Action::Close`], which
    /// the window handles.
    pub fn act(&mut self, action: Action, side: Side) -> bool {
        match action {
            Action::Method { index, other } => {
                let side = if other { side.other() } else { side };
                self.panes.choose(side, index);
            }
            Action::Turn(azimuth, elevation) => self.turn(azimuth, elevation),
            Action::Zoom(factor) => {
                self.orbit.zoom(factor);
                self.is_stale = true;
            }
            Action::Divide(part) => self.panes.divide_by(part),
            Action::Swap => {
                self.panes.swap();
                self.kept.swap(0, 1);
            }
            Action::ShowNext => self.panes.show_next(),
            Action::CarryLights => {
                self.carries_lights ^= true;
                self.is_stale = true;
            }
            Action::Reset => {
                self.orbit = Orbit::default();
                self.is_stale = true;
            }
            Action::Close => return false,
        }
        true
    }

    /// Turns the camera, as [`Orbit::turn`] does.
    pub fn turn(&mut self, azimuth: f64, elevation: f64) {
        self.orbit.turn(&self.loaded.start, azimuth, elevation);
        self.is_stale = true;
    }

    /// Draws the panes into `window`, whose rows are `width` pixels long and contiguous; `scale` is
    /// as in [`Panes::compose`]. Projects the scene only if camera, size, lights or scene have
    /// changed, and draws a picture only if its frame or method has.
    ///
    /// # Errors
    /// As [`Scene::frame`], if the camera has gone too far.
    pub fn draw(&mut self, window: &mut [u32], width: usize, scale: f64) -> Result<(), FrameError> {
        let height = window.len() / width;
        self.project([width, height])?;
        match *self.panes.shown() {
            // A single side is drawn straight into the window and not kept.
            [side] => {
                self.draw_side(side, window, width);
                self.kept[side as usize].frame = None;
            }
            // Two pictures are kept outside the window, so that moving the divider needs no
            // drawing.
            _ => {
                for side in [Side::Left, Side::Right] {
                    if self.is_to_be_drawn(side) {
                        let mut pixels = std::mem::take(&mut self.kept[side as usize].pixels);
                        pixels.resize(width * height, 0);
                        self.draw_side(side, &mut pixels, width);
                        self.kept[side as usize].pixels = pixels;
                    }
                }
                let [left, right] = &self.kept;
                self.panes
                    .compose(window, [&left.pixels, &right.pixels], width, scale);
            }
        }
        Ok(())
    }

    /// True if the picture of `side` is out of date, or the time of its method is not known yet.
    fn is_to_be_drawn(&self, side: Side) -> bool {
        let kept = &self.kept[side as usize];
        kept.frame != Some(self.generation) || self.wants_time(side)
    }

    /// Draws the picture of `side` and records the time.
    fn draw_side(&mut self, side: Side, pixels: &mut [u32], width: usize) {
        let (index, method) = (self.panes.index(side), self.panes.method(side));
        let kept = &mut self.kept[side as usize];
        if kept.method.replace(index) != Some(index) {
            kept.times.clear();
        }
        let started = Instant::now();
        let drawn = draw(method, &self.frame, self.renderer, pixels, width);
        kept.times.add(started.elapsed());
        if drawn.is_err() {
            pixels.fill(NO_PICTURE);
        }
        kept.refused = drawn.err();
        kept.frame = Some(self.generation);
    }

    /// Projects the scene if camera, size, lights or scene have changed, or if the time of
    /// projecting is not known yet.
    fn project(&mut self, size: [usize; 2]) -> Result<(), FrameError> {
        if self.size != size {
            self.size = size;
            self.forget_times();
            self.is_stale = true;
        }
        if self.is_stale {
            let [width, height] = size.map(|side| side.clamp(1, self.loaded.most) as u32);
            let Loaded {
                prepared,
                start,
                lights,
                ..
            } = &mut self.loaded;
            let aspect = f64::from(width) / f64::from(height);
            prepared.set_size(width, height);
            prepared.set_camera(self.orbit.camera(start, aspect));
            prepared.set_lights(if self.carries_lights {
                self.orbit.carry(start, lights)
            } else {
                lights.clone()
            });
            self.generation += 1;
            self.is_stale = false;
        } else if !self.projecting.are_few() {
            return Ok(());
        }
        let started = Instant::now();
        self.loaded.prepared.frame_into(&mut self.frame)?;
        self.projecting.add(started.elapsed());
        Ok(())
    }

    /// True if the times are not known yet, so that drawing once more helps.
    pub fn wants_times(&self) -> bool {
        let mut sides = self.panes.shown().iter();
        self.projecting.are_few() || sides.any(|side| self.wants_time(*side))
    }

    fn wants_time(&self, side: Side) -> bool {
        let kept = &self.kept[side as usize];
        !self.has_drawn(side) || kept.times.are_few() && kept.refused.is_none()
    }

    /// True if the picture kept for `side` was drawn by the method chosen there.
    fn has_drawn(&self, side: Side) -> bool {
        self.kept[side as usize].method == Some(self.panes.index(side))
    }

    fn forget_times(&mut self) {
        self.projecting.clear();
        for kept in &mut self.kept {
            kept.times.clear();
        }
    }

    /// Returns the title of the window: the methods with their times, the time of projecting, the
    /// scene and the size.
    pub fn title(&self) -> String {
        let time = |times: &Times| match times.milliseconds() {
            Some(milliseconds) => format!("{milliseconds:.2} ms"),
            None => "…".into(),
        };
        let mut parts = Vec::new();
        for &side in self.panes.shown() {
            let (method, kept) = (self.panes.method(side), &self.kept[side as usize]);
            parts.push(match &kept.refused {
                _ if !self.has_drawn(side) => format!("{method} …"),
                Some(error) => format!("{method}: {error}"),
                None => format!("{method} {}", time(&kept.times)),
            });
        }
        parts.push(format!("projection {}", time(&self.projecting)));
        let [width, height] = self.size;
        parts.push(format!("{} {width}x{height}", self.name));
        parts.join(" | ")
    }
}

/// Draws `frame` into `pixels`, whose rows are `width` pixels long.
///
/// # Errors
/// If the method cannot draw this frame.
fn draw(
    method: &Variant,
    frame: &Frame,
    renderer: Renderer,
    pixels: &mut [u32],
    width: usize,
) -> Result<(), DrawError> {
    let (columns, rows) = (frame.picture_width(), frame.picture_height());
    if columns * rows < pixels.len() {
        // The window is larger than the largest picture.
        pixels.fill(NO_PICTURE);
    }
    let picture = PictureMut::argb(pixels, columns, rows).stride(width);
    method.draw(frame, picture, DrawOptions::by(renderer))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastphong::mesh::builtin::builtin;
    use std::vec;

    const SIZE: [usize; 2] = [64, 48];

    fn viewer(names: &[&str], samples: u32) -> Viewer {
        let mut scene = Scene::of_mesh(builtin("torus").expect("a shape"));
        [scene.width, scene.height] = SIZE.map(|side| side as u32);
        scene.samples = samples;
        let loaded = Loaded::new(&scene, [false; 2]).expect("a scene");
        let methods = names.iter().map(|name| Variant::parse(name));
        let panes = Panes::new(methods.collect::<Result<_, _>>().expect("methods"));
        Viewer::new(loaded, "torus", panes, Renderer::Span).expect("a frame")
    }

    fn shown(viewer: &mut Viewer, [width, height]: [usize; 2]) -> Vec<u32> {
        let mut window = vec![7; width * height];
        viewer.draw(&mut window, width, 1.0).expect("a picture");
        window
    }

    /// Returns how many frames were projected so far.
    fn frames(viewer: &Viewer) -> u64 {
        viewer.generation
    }

    #[test]
    fn each_side_is_the_picture_of_its_method() {
        for samples in [1, 2] {
            let mut viewer = viewer(&["flat", "naive-phong"], samples);
            let window = shown(&mut viewer, SIZE);
            let mut frame = viewer.loaded.frame().expect("a frame");
            frame.set_alpha(Alpha::Flattened);
            for (method, columns) in [("flat", 0..20), ("naive-phong", 44..64)] {
                let picture = Variant::parse(method)
                    .expect("a method")
                    .render(&frame)
                    .expect("a method for the frame");
                for y in 0..SIZE[1] {
                    for x in columns.clone() {
                        let [r, g, b, _] = picture.pixels()[SIZE[0] * y + x];
                        let colour = u32::from_be_bytes([0, r, g, b]);
                        // The knob, in the middle, is narrower than what lies between these
                        // columns.
                        assert_eq!(window[SIZE[0] * y + x] & 0xff_ffff, colour, "{x}, {y}");
                    }
                }
            }
            // Alone it is the whole picture, with nothing before it.
            viewer.act(Action::ShowNext, Side::Left);
            let alone = shown(&mut viewer, SIZE);
            let picture = Variant::parse("flat")
                .expect("a method")
                .render(&frame)
                .expect("a method for the frame");
            let colours = picture
                .pixels()
                .iter()
                .map(|&[r, g, b, _]| u32::from_be_bytes([0, r, g, b]));
            assert!(alone.iter().map(|pixel| pixel & 0xff_ffff).eq(colours));
        }
    }

    #[test]
    fn only_what_has_changed_is_made_anew() {
        let mut viewer = viewer(&["flat", "naive-phong", "gouraud"], 1);
        while viewer.wants_times() {
            shown(&mut viewer, SIZE);
        }
        assert_eq!(frames(&viewer), 1, "measuring changes nothing");
        let stale =
            |viewer: &Viewer| [Side::Left, Side::Right].map(|side| viewer.is_to_be_drawn(side));
        assert_eq!(stale(&viewer), [false, false]);
        let before = shown(&mut viewer, SIZE);
        viewer.act(Action::Divide(0.2), Side::Left);
        assert_eq!(
            stale(&viewer),
            [false, false],
            "the divider moves over both"
        );
        assert_ne!(shown(&mut viewer, SIZE), before);
        viewer.act(
            Action::Method {
                index: 2,
                other: true,
            },
            Side::Left,
        );
        assert_eq!(stale(&viewer), [false, true]);
        while viewer.wants_times() {
            shown(&mut viewer, SIZE);
        }
        viewer.act(Action::Swap, Side::Left);
        assert_eq!(
            stale(&viewer),
            [false, false],
            "pictures are exchanged as they are"
        );
        assert_eq!((viewer.is_stale, frames(&viewer)), (false, 1));
        viewer.act(Action::Turn(0.1, 0.0), Side::Left);
        shown(&mut viewer, SIZE);
        assert_eq!(frames(&viewer), 2);
        viewer.act(Action::Reset, Side::Left);
        viewer.act(Action::Divide(-0.2), Side::Left);
        viewer.act(Action::Swap, Side::Left);
        viewer.act(
            Action::Method {
                index: 1,
                other: false,
            },
            Side::Right,
        );
        assert_eq!(shown(&mut viewer, SIZE), before, "and back again");
        shown(&mut viewer, [80, 20]);
        assert_eq!(frames(&viewer), 4);
    }

    #[test]
    fn the_title_says_what_is_shown_and_what_it_takes() {
        let mut viewer = viewer(&["flat", "gouraud"], 1);
        shown(&mut viewer, SIZE);
        assert_eq!(
            viewer.title(),
            "flat … | gouraud … | projection … | torus 64x48"
        );
        while viewer.wants_times() {
            shown(&mut viewer, SIZE);
        }
        let title = viewer.title();
        assert!(
            title.starts_with("flat ") && title.contains(" ms | gouraud "),
            "{title}"
        );
        viewer.act(Action::ShowNext, Side::Left);
        viewer.act(Action::ShowNext, Side::Left);
        assert!(viewer.title().starts_with("gouraud "));
    }

    #[test]
    fn carried_lights_light_the_other_side_too() {
        let mut viewer = viewer(&["gouraud"], 1);
        let bright = |viewer: &mut Viewer| -> u64 {
            let pixels = shown(viewer, SIZE);
            pixels.iter().map(|pixel| u64::from(pixel & 0xff)).sum()
        };
        viewer.turn(std::f64::consts::PI, 0.0);
        let behind = bright(&mut viewer);
        viewer.act(Action::CarryLights, Side::Left);
        let carried = bright(&mut viewer);
        assert!(carried > behind, "{carried} {behind}");
    }

    #[test]
    fn a_window_beyond_the_largest_picture_shows_a_smaller_one() {
        let mut viewer = viewer(&["flat"], 8);
        viewer.loaded.most = 32;
        let window = shown(&mut viewer, [40, 8]);
        assert_eq!(window[39], NO_PICTURE);
        assert_ne!(window[0], 7);
    }
}
