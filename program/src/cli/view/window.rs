//! The window: passes events to the viewer, and its pictures to the screen.

use super::super::CliError;
use super::super::log::{colour, to_stderr};
use crate::view::{Action, Loaded, Side, Viewer};
use rayon::ThreadPool;
use softbuffer::{Context, Surface};
use std::num::NonZeroU32;
use std::rc::Rc;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, OwnedDisplayHandle};
use winit::keyboard::{ModifiersState, PhysicalKey};
use winit::window::{CursorIcon, Window, WindowId};

/// The time between two titles. Numbers that change faster cannot be read.
const TITLE: Duration = Duration::from_millis(250);

/// How far from the divider the pointer can grab it, in logical pixels.
const REACH: f64 = 8.0;

/// The zoom factor for one line of a wheel, and how many pixels of a touchpad count as a line.
const LINE: (f64, f64) = (1.1, 40.0);

/// A scene that was loaded again, or the error.
type Reloaded = Result<Loaded, CliError>;

/// Opens a window and shows what `viewer` draws on `pool`, until the window is closed. A thread
/// calls `reload`, which waits for a change of the scene's files and loads it. `opened` is called
/// once the display is there.
///
/// # Errors
/// If there is no display, the window cannot be opened, or the scene cannot be drawn.
pub fn show(
    viewer: Viewer,
    pool: ThreadPool,
    reload: Option<impl Fn() -> Reloaded + Send + 'static>,
    opened: impl FnOnce(),
) -> Result<(), CliError> {
    let events = EventLoop::<Reloaded>::with_user_event().build();
    let events = events.map_err(no_display)?;
    let context = Context::new(events.owned_display_handle()).map_err(no_display)?;
    opened();
    if let Some(reload) = reload {
        let proxy = events.create_proxy();
        // The thread ends with the program.
        std::thread::spawn(move || while proxy.send_event(reload()).is_ok() {});
    }
    let mut shown = Shown {
        viewer,
        pool,
        context,
        surface: None,
        failure: None,
        modifiers: ModifiersState::empty(),
        pointer: None,
        drag: Drag::None,
        title: (String::new(), Instant::now()),
    };
    events.run_app(&mut shown).map_err(no_display)?;
    match shown.failure {
        Some(failure) => Err(failure),
        None => Ok(()),
    }
}

/// Returns the error for a window that cannot be opened.
fn no_display(error: impl std::fmt::Display) -> CliError {
    let error = error.to_string();
    // Some errors begin with a file and line in the source of a library.
    let reason = match error.strip_prefix("os error at ") {
        Some(rest) => rest.splitn(3, ':').last().unwrap_or(rest).trim(),
        None => &*error,
    };
    let reason = reason.trim_end_matches('.');
    let expected = "expected a desktop (Wayland or X11); `fastphong render` draws into a file";
    format!("no window can be opened: {reason}: {expected}").into()
}

/// What a drag moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drag {
    None,
    Camera,
    Divider,
}

/// The window and the state that its events change.
struct Shown {
    viewer: Viewer,
    pool: ThreadPool,
    context: Context<OwnedDisplayHandle>,
    /// `None` until the window is opened by the first event.
    surface: Option<Surface<OwnedDisplayHandle, Rc<Window>>>,
    /// The error that closed the window.
    failure: Option<CliError>,
    modifiers: ModifiersState,
    /// The pointer's position in pixels from the upper left corner, while it is in the window.
    pointer: Option<PhysicalPosition<f64>>,
    drag: Drag,
    /// The title, and when it was set.
    title: (String, Instant),
}

impl Shown {
    /// Opens the window.
    fn open(&mut self, events: &ActiveEventLoop) -> Result<(), CliError> {
        let [width, height] = self.viewer.wanted_size();
        let monitor = events.primary_monitor().map(|monitor| monitor.size());
        // Some monitors report no size.
        let most = monitor.filter(|size| size.width > 0 && size.height > 0);
        let most = most.unwrap_or(PhysicalSize::new(4096, 4096));
        let size = PhysicalSize::new(width.min(most.width), height.min(most.height));
        let attributes = Window::default_attributes()
            .with_title(self.viewer.title())
            .with_inner_size(size);
        let window = Rc::new(events.create_window(attributes).map_err(no_display)?);
        let surface = Surface::new(&self.context, window.clone()).map_err(no_display)?;
        window.request_redraw();
        self.surface = Some(surface);
        Ok(())
    }

    fn window(&self) -> Option<&Window> {
        self.surface.as_ref().map(|surface| &**surface.window())
    }

    fn redraw(&self) {
        if let Some(window) = self.window() {
            window.request_redraw();
        }
    }

    /// Draws into the window's memory and shows the result.
    fn draw(&mut self) -> Result<(), CliError> {
        let Some(surface) = &mut self.surface else {
            return Ok(());
        };
        let window = surface.window().clone();
        let size = window.inner_size();
        // A hidden window may have no pixels.
        let (Some(width), Some(height)) =
            (NonZeroU32::new(size.width), NonZeroU32::new(size.height))
        else {
            return Ok(());
        };
        surface.resize(width, height).map_err(no_display)?;
        let mut buffer = surface.buffer_mut().map_err(no_display)?;
        let pixels = &mut *buffer;
        let (viewer, scale) = (&mut self.viewer, window.scale_factor());
        self.pool
            .install(|| viewer.draw(pixels, width.get() as usize, scale))?;
        window.pre_present_notify();
        buffer.present().map_err(no_display)?;
        if self.viewer.wants_times() {
            window.request_redraw();
        }
        Ok(())
    }

    /// Returns the action of a pressed key. Keys with modifiers other than Shift belong to the
    /// desktop.
    fn action(&self, key: KeyEvent) -> Option<Action> {
        let PhysicalKey::Code(code) = key.physical_key else {
            return None;
        };
        if !(self.modifiers - ModifiersState::SHIFT).is_empty() {
            return None;
        }
        // winit names keys as UI Events does.
        let action = Action::of_key(&format!("{code:?}"), self.modifiers.shift_key())?;
        (!key.repeat || action.repeats()).then_some(action)
    }

    fn act(&mut self, action: Action, events: &ActiveEventLoop) {
        if action == Action::Close {
            return events.exit();
        }
        let side = self.pointer.map_or(Side::Left, |pointer| {
            self.viewer.panes.side_at(pointer.x, self.width())
        });
        self.viewer.act(action, side);
        self.redraw();
    }

    fn width(&self) -> usize {
        self.window()
            .map_or(0, |window| window.inner_size().width as usize)
    }

    /// True if the pointer is near enough to grab the divider.
    fn is_on_divider(&self) -> bool {
        let scale = self.window().map_or(1.0, Window::scale_factor);
        self.pointer.is_some_and(|pointer| {
            let panes = &self.viewer.panes;
            panes.is_on_divider(pointer.x, self.width(), REACH * scale)
        })
    }

    /// Moves what is dragged, or changes the cursor over the divider.
    fn move_to(&mut self, pointer: PhysicalPosition<f64>) {
        let before = self.pointer.replace(pointer);
        let Some(window) = self.window() else {
            return;
        };
        let size = window.inner_size();
        match (self.drag, before) {
            (Drag::Camera, Some(before)) => {
                // A drag across the shorter side is half a turn. The signs make the object follow
                // the pointer.
                let angle = std::f64::consts::PI / f64::from(size.width.min(size.height).max(1));
                let (x, y) = (pointer.x - before.x, pointer.y - before.y);
                self.viewer.turn(-angle * x, angle * y);
                self.redraw();
            }
            (Drag::Divider, _) => {
                let panes = &mut self.viewer.panes;
                panes.divide_at(pointer.x, size.width as usize);
                self.redraw();
            }
            _ => {
                window.set_cursor(if self.is_on_divider() {
                    CursorIcon::EwResize
                } else {
                    CursorIcon::Default
                });
            }
        }
    }

    /// Sets the title if it has changed and the last one was shown long enough. Otherwise returns
    /// when to try again.
    fn tell(&mut self) -> Option<Instant> {
        let title = self.viewer.title();
        if title == self.title.0 {
            return None;
        }
        let next = self.title.1 + TITLE;
        if Instant::now() < next {
            return Some(next);
        }
        if let Some(window) = self.window() {
            window.set_title(&title);
        }
        self.title = (title, Instant::now());
        None
    }
}

impl ApplicationHandler<Reloaded> for Shown {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.surface.is_none() {
            self.failure = self.open(events).err();
            if self.failure.is_some() {
                events.exit();
            }
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, reloaded: Reloaded) {
        match reloaded {
            Ok(loaded) => self.viewer.replace(loaded),
            // Keep showing the old scene: a later change may fix the error.
            Err(failure) => to_stderr(&failure.render(colour())),
        }
        self.redraw();
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => events.exit(),
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => self.redraw(),
            WindowEvent::RedrawRequested => {
                if let Err(failure) = self.draw() {
                    self.failure = Some(failure);
                    events.exit();
                }
            }
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::Focused(false) => self.drag = Drag::None,
            // Synthetic events are keys that were already down when the window got the focus. They
            // were not meant for it.
            WindowEvent::KeyboardInput {
                event,
                is_synthetic: false,
                ..
            } if event.state == ElementState::Pressed => {
                if let Some(action) = self.action(event) {
                    self.act(action, events);
                }
            }
            WindowEvent::CursorMoved { position, .. } => self.move_to(position),
            WindowEvent::CursorLeft { .. } if self.drag == Drag::None => self.pointer = None,
            WindowEvent::MouseInput {
                state,
                button: MouseButton::Left,
                ..
            } => {
                self.drag = match state {
                    ElementState::Pressed if self.is_on_divider() => Drag::Divider,
                    ElementState::Pressed => Drag::Camera,
                    ElementState::Released => Drag::None,
                };
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let lines = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
                    MouseScrollDelta::PixelDelta(delta) => delta.y / LINE.1,
                };
                self.act(Action::Zoom(LINE.0.powf(lines)), events);
            }
            _ => {}
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        events.set_control_flow(match self.tell() {
            Some(next) => ControlFlow::WaitUntil(next),
            None => ControlFlow::Wait,
        });
    }
}
