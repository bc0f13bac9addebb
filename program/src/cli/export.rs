//! `fastphong export`: writes a scene for other programs.

use super::contents::Contents;
use super::measured::command_line;
use super::output::{self, ForceFlag, Output, print_beside};
use super::scene_flags::{SceneFlags, frame_of, note_scene};
use super::text::counted;
use super::{CliError, Log, Outcome, input_name, memory};
use crate::export::{Export, ExportError, Faces, NAMES, memory_needed};
use fastphong::drawing::Drawing;
use fastphong::memory::{bytes, check_free};
use fastphong::picture::image_file::Format;
use fastphong::reference::Model;
use fastphong::scene::open::Look;
use std::path::{Path, PathBuf};

/// Write a scene for your own renderer: mesh in world space, matrices, lights, the right picture
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub struct ExportArgs {
    /// Scene file, mesh file, builtin:NAME?key=value, name of a shipped scene, or `-` for standard
    /// input; a mesh without a scene as `compare` and `diagnose` draw it
    #[arg(value_parser = input_name::parser())]
    input: String,
    /// Folder for the files; it is made if needed
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Write polygons as they are, not cut into triangles. The expected picture then shows
    /// polygons, too
    #[arg(long)]
    polygons: bool,
    #[command(flatten)]
    force: ForceFlag,
    #[command(flatten)]
    scene: SceneFlags,
}

const AFTER: &str = "README.txt in the folder says what each file holds. \
    report/course/check-your-own.md shows how to use them.";

/// Bytes per pixel of the PNG file, beside the stored picture.
const PNG_PIXEL: u64 = 4;

impl ExportArgs {
    /// Draws the picture and writes all files.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let folder = output::folder("--output", &self.output)?;
        let file = self.scene.read(&self.input)?;
        let mut opened = self.scene.open_file(file, Look::Compared)?;
        let outputs = NAMES.map(|name| self.file(folder, name));
        let all: Vec<&Output> = outputs.iter().collect();
        // Only now are the material libraries of the meshes known.
        output::check(&all)?;
        if std::mem::replace(&mut opened.scene.samples, 1) > 1 {
            log.note("the picture shows a single sample per pixel, in its middle (--samples 1)");
        }
        note_scene(&opened, log);
        let needed = memory_needed(&opened.scene);
        let needs = format!("the mesh as text needs about {}", bytes(needed));
        check_free(needed, &needs, "fewer polygons")?;
        drop(frame_of(&opened, log)?);
        log.notes(
            &self
                .scene
                .unused("the picture, which has no alpha", &["alpha"]),
        );
        let faces = if self.polygons {
            Faces::Polygons
        } else {
            Faces::Triangles
        };
        let export = Export::new(&opened.scene, &scene_words(&self.input), faces);
        let export = export.map_err(|error| match error {
            ExportError::Corners { .. } => format!("{error}; or --polygons"),
            error => error.to_string(),
        })?;
        if export.left_out() > 0 {
            let one = "polygon crosses or overlaps itself and is left out";
            let more = "polygons cross or overlap themselves and are left out";
            let left_out = counted(export.left_out(), one, more);
            log.warning(&format!(
                "{left_out}: --polygons writes polygons as they are"
            ));
        }
        memory::check_stored(export.frame(), &Drawing::Reference(Model::Phong), PNG_PIXEL)?;
        let files = export.files()?;
        let contents = files.iter().map(|(_, bytes)| &bytes[..]);
        output::write_together(outputs.iter().zip(contents))?;
        print_beside(&all, &output::written(&all))?;
        Ok(Outcome::Done)
    }

    fn file(&self, folder: &Path, name: &str) -> Output {
        let path = folder.join(name);
        let contents = match Format::of_path(&path) {
            Ok(format) => Contents::Picture(format),
            Err(_) => Contents::Export,
        };
        Output::chosen("--output", path, contents, self.force)
    }
}

/// Returns the words of the command line that say which scene it is: the input and its flags.
fn scene_words(input: &str) -> String {
    let own = ["--polygons", "--force", "-q", "--quiet", "-v", "--verbose"];
    let mut words = command_line().into_iter().skip(1);
    let mut kept = Vec::new();
    while let Some(word) = words.next() {
        if word == "-o" || word == "--output" {
            words.next();
        } else if !word.starts_with("-o") && !word.starts_with("--output=") {
            kept.push(word);
        }
    }
    kept.retain(|word| !own.contains(&&**word) && word != "export" && word != input);
    kept.insert(0, input.to_owned());
    kept.join(" ")
}
