//! Your own window: `Variant::draw` draws straight into its memory, frame after frame, while one
//! part of the scene spins.
//!
//! ```text
//! cargo run --release --features view --example window
//! cargo run --release --features view --example window gouraud
//! ```
//!
//! This example uses `winit` for the window and `softbuffer` for its memory. Any other libraries
//! that give access to rows of pixels will do. `fastphong view` is a complete viewer.

use fastphong::frame::{Frame, PreparedScene};
use fastphong::glam::{DAffine3, DVec3};
use fastphong::mesh::builtin::builtin;
use fastphong::picture::PictureMut;
use fastphong::raster::{DrawOptions, Renderer};
use fastphong::scene::Scene;
use fastphong::shading::Variant;
use softbuffer::{Context, Surface};
use std::error::Error;
use std::num::NonZeroU32;
use std::rc::Rc;
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop, OwnedDisplayHandle};
use winit::window::{Window, WindowId};

/// The scene, and the window that shows it.
struct Spinning {
    scene: PreparedScene,
    /// The current frame. The next frame reuses its memory.
    frame: Frame,
    method: Variant,
    start: Instant,
    context: Context<OwnedDisplayHandle>,
    /// The window's surface, which exists from the first event on.
    surface: Option<Surface<OwnedDisplayHandle, Rc<Window>>>,
    failure: Option<Box<dyn Error>>,
}

impl Spinning {
    fn open(&mut self, events: &ActiveEventLoop) -> Result<(), Box<dyn Error>> {
        let window = Window::default_attributes().with_title(format!("fastphong: {}", self.method));
        let window = Rc::new(events.create_window(window)?);
        self.surface = Some(Surface::new(&self.context, window)?);
        Ok(())
    }

    /// Draws the next frame into the window's memory, and shows it.
    fn draw(&mut self) -> Result<(), Box<dyn Error>> {
        let Some(surface) = &mut self.surface else {
            return Ok(());
        };
        let size = surface.window().inner_size();
        // A window that is hidden may have no pixels.
        let (Some(width), Some(height)) =
            (NonZeroU32::new(size.width), NonZeroU32::new(size.height))
        else {
            return Ok(());
        };
        surface.resize(width, height)?;
        let mut pixels = surface.buffer_mut()?;
        self.scene.set_size(size.width, size.height);
        let turn = DAffine3::from_rotation_x(self.start.elapsed().as_secs_f64());
        self.scene.set_transform(1, turn)?;
        self.scene.frame_into(&mut self.frame)?;
        let picture = PictureMut::argb(&mut pixels, size.width as usize, size.height as usize);
        let options = DrawOptions::by(Renderer::fastest());
        self.method.draw(&self.frame, picture, options)?;
        pixels.present()?;
        surface.window().request_redraw();
        Ok(())
    }
}

impl ApplicationHandler for Spinning {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.surface.is_none() {
            self.failure = self.open(events).err();
        }
        if self.failure.is_some() {
            events.exit();
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::RedrawRequested => {
                self.failure = self.draw().err();
                if self.failure.is_some() {
                    events.exit();
                }
            }
            _ => (),
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let method = std::env::args().nth(1);
    let mut scene = Scene::of_mesh(builtin("sphere")?);
    scene.objects[0].transform = DAffine3::from_scale(DVec3::splat(0.5));
    let mut torus = scene.objects[0].clone();
    torus.mesh = builtin("torus")?.into();
    torus.transform = DAffine3::IDENTITY;
    scene.objects.push(torus);
    let scene = scene.prepare()?;
    let no_display = |error| format!("no window can be opened: {error}");
    let events = EventLoop::new().map_err(no_display)?;
    let mut spinning = Spinning {
        frame: scene.frame()?,
        scene,
        method: Variant::parse(method.as_deref().unwrap_or("phong-rsqrt"))?,
        start: Instant::now(),
        context: Context::new(events.owned_display_handle())?,
        surface: None,
        failure: None,
    };
    events.run_app(&mut spinning)?;
    spinning.failure.map_or(Ok(()), Err)
}
