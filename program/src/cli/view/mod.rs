//! `fastphong view`: shows a scene in a window, drawn by two methods side by side.

mod window;

use super::engines::{self, Simd, ThreadFlags, renderer};
use super::input_name;
use super::measured::{Methods, methods, warn_of_debug_build};
use super::name_template::scene_name;
use super::scene_flags::{SceneFlags, note_frame};
use super::watch::Watched;
use super::{CliError, Log, Outcome, memory};
use crate::view::{Action, Loaded, Panes, Viewer};
use fastphong::raster::Renderer;
use fastphong::scene::open::Look;

/// Show a scene or a mesh in a window: turn it, and compare two methods by a divider
#[derive(clap::Args, Clone, Debug)]
#[command(after_help = KEYS)]
pub struct ViewArgs {
    /// Scene file, mesh file, builtin:NAME?key=value, name of a shipped scene, or `-` for standard
    /// input
    #[arg(value_parser = input_name::parser())]
    input: String,
    /// Methods for the keys 1 to 9, separated by commas, with parameters as in
    /// `fast-phong:steps=1`. The window opens with the first two
    #[arg(short, long, visible_alias = "method", value_name = "METHODS", default_value = METHODS, value_parser = at_most_nine)]
    methods: Methods,
    /// Engine that finds the pixels: `span`, as in the lecture, one pixel at a time; `row`, with
    /// SIMD; or `auto`, which is `row` if it can draw the scene, else `span`
    #[arg(long, default_value = "auto", value_parser = engines::scanline_engine)]
    engine: engines::ScanlineEngine,
    /// Instruction set of the pixel loops: `auto` (the best on this machine) or one of
    /// `fastphong list simd`. `scalar` selects the span engine, any other the row engine
    #[arg(long, value_name = "ISA", default_value = "auto", value_parser = engines::simd)]
    simd: Simd,
    #[command(flatten)]
    threads: ThreadFlags,
    /// Load again whenever a file of the scene changes
    #[arg(long)]
    watch: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

/// The methods for the keys 1 to 9, those of the lecture first.
const METHODS: &str = "gouraud,fast-phong,naive-phong,phong-rsqrt,flat,duff-phong,six-point,slerp-phong,fast-phong-rsqrt";

const KEYS: &str = "In the window:\n  \
    1 to 9         choose the method on the side of the pointer; with Shift, on the other side\n  \
    drag, arrows   turn; Home returns to the camera of the scene\n  \
    wheel, + -     zoom\n  \
    drag the line  compare; also Shift with arrows. Space shows one side only, Tab swaps them\n  \
    L              make the lights turn with the eye, or stay\n  \
    Esc, Q         close\n\
    The title names the methods, with the time for each picture and for the projection that both share.";

/// Reads methods, at most one for each key.
fn at_most_nine(text: &str) -> Result<Methods, String> {
    let methods = methods(text).map_err(|error| error.to_string())?;
    match methods.len() {
        0..=Panes::MOST => Ok(methods),
        more => Err(format!(
            "{more} methods, but only {} keys: expected fewer methods",
            Panes::MOST
        )),
    }
}

impl ViewArgs {
    /// Opens the window, and returns when it is closed.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let renderer = renderer(Some(self.engine), Some(self.simd), Renderer::fastest())?;
        let watched = self.watch.then(|| Watched::new(&self.input)).transpose()?;
        if let Some(watched) = &watched {
            watched.begin();
        }
        let pool = self.threads.pool()?;
        warn_of_debug_build(log);
        // Load first: an error in the scene is more useful than one about a missing display.
        let loaded = pool.install(|| self.load(log))?;
        let panes = Panes::new(self.methods.clone());
        let name = scene_name(&self.input);
        let viewer = Viewer::new(loaded, name, panes, renderer)?;
        let reload = watched.map(|watched| {
            let (args, threads) = (self.clone(), self.threads);
            // The file existed when the window opened. Now it may change in any way, even
            // disappear; the next change is waited for.
            move || {
                watched.wait(log, "Esc in the window");
                watched.begin();
                threads.install(|| args.load(log))?
            }
        });
        window::show(viewer, pool, reload, || {
            let methods = self.methods.iter().enumerate();
            let methods: Vec<_> = methods.map(|(n, m)| format!("{} {m}", n + 1)).collect();
            log.note(&format!(
                "{}: {}\n{}",
                name,
                methods.join(", "),
                Action::KEYS
            ));
        })?;
        Ok(Outcome::Done)
    }

    /// Loads and prepares the scene.
    fn load(&self, log: Log) -> Result<Loaded, CliError> {
        let opened = self.scene.open(&self.input, Look::Shown, log)?;
        memory::check_frame(&opened.scene)?;
        let given = ["camera.near", "camera.far"].map(|key| opened.file.states(key));
        let loaded = Loaded::new(&opened.scene, given)?;
        note_frame(&opened, &loaded.frame()?, log);
        Ok(loaded)
    }
}
