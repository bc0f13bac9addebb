//! Where commands write: every file that one makes is an [`Output`], whatever it holds.
//!
//! | | |
//! |---|---|
//! | `-` | standard output, for one output of a command. Its text then goes to standard error |
//! | an ending | must be one of the contents' own, if there is one: a page is not called `.png` |
//! | a name that the command chose | replaces only a file that fastphong made before ([`contents`](super::contents)), unless `--force` says so |
//! | a file that is read, or written already | is never written: see [`files`] |

use super::CliError;
use super::contents::Contents;
use super::files::{self, Destination};
use super::log::{to_stderr, to_stdout, to_stdout_by};
use fastphong::picture::image_file::{FilePicture, Format};
use fastphong::scene::input::has_ending;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// A file that a command makes, or standard output.
#[derive(Clone, Debug)]
pub struct Output {
    /// The flag that asks for it: `--output`.
    name: &'static str,
    /// `None`: standard output.
    path: Option<PathBuf>,
    contents: Contents,
    /// The check of a path before it is written.
    rule: Rule,
}

/// The check of a path before it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// Given by the user: its ending may not contradict the contents.
    Ending,
    /// Given by the user with a `--format`, or chosen by the command with `--force`.
    None,
    /// Chosen by the command: a file there must be one that fastphong made.
    Own,
}

/// `--force`, for commands that choose names of files.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ForceFlag {
    /// Replace files that fastphong did not make where it chooses the name. A file that a flag names is always replaced
    #[arg(long)]
    pub force: bool,
}

impl Output {
    /// Makes the output that the flag `name` gives the path of; `-` is standard output.
    pub fn new(name: &'static str, path: &Path, contents: Contents) -> Output {
        Output {
            name,
            path: (path.as_os_str() != "-").then(|| path.to_owned()),
            contents,
            rule: Rule::Ending,
        }
    }

    /// Makes the output of a page: at the path that `--output` gives, else at the `default` of the command.
    pub fn page(given: Option<&Path>, default: impl FnOnce() -> String, force: ForceFlag) -> Self {
        match given {
            Some(path) => Output::new("--output", path, Contents::Page),
            None => Output::chosen("--output", default().into(), Contents::Page, force),
        }
    }

    /// Makes an output whose path the command chooses.
    pub fn chosen(name: &'static str, path: PathBuf, contents: Contents, force: ForceFlag) -> Self {
        Output {
            name,
            path: Some(path),
            contents,
            rule: if force.force { Rule::None } else { Rule::Own },
        }
    }

    /// Makes the output of `--output` for a picture: in `format`, else by the ending of the path, else PNG on standard output.
    ///
    /// # Errors
    /// When neither names a format, or standard output is a terminal.
    pub fn of_picture(path: &Path, format: Option<Format>) -> Result<Output, CliError> {
        let is_stdout = path.as_os_str() == "-";
        if is_stdout && io::stdout().is_terminal() {
            let expected = "expected `-o FILE`, or `-o -` into a pipe or a file";
            return Err(format!("a picture is not for a terminal: {expected}").into());
        }
        let by_path = match is_stdout {
            true => Ok(Format::Png),
            false => Format::of_path(path),
        };
        let contents = Contents::Picture(format.map_or(by_path, Ok)?);
        Ok(Output {
            rule: Rule::None,
            ..Output::new("--output", path, contents)
        })
    }

    /// True if this is standard output.
    pub fn is_stdout(&self) -> bool {
        self.path.is_none()
    }

    /// Returns the path of the file; `None` for standard output.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Returns the path of the file, to be changed.
    pub fn path_mut(&mut self) -> Option<&mut PathBuf> {
        self.path.as_mut()
    }

    /// Returns the format of a picture.
    pub fn format(&self) -> Option<Format> {
        match self.contents {
            Contents::Picture(format) => Some(format),
            _ => None,
        }
    }

    /// Returns the place as [`files`] compares it with those of other files.
    fn destination(&self) -> Destination<'_> {
        Destination {
            name: self.name,
            path: self.path().unwrap_or(Path::new(files::STDOUT)),
        }
    }

    /// Makes the folder of the file, if there is none.
    ///
    /// # Errors
    /// When that cannot be, or the path is a folder itself.
    pub fn make_folder(&self) -> Result<(), CliError> {
        let Some(path) = self.path() else {
            return Ok(());
        };
        let refused = |reason: &str| format!("{}: cannot be written: {reason}", path.display());
        if path.file_name().is_none() || path.is_dir() {
            let ending = self.contents.endings()[0];
            let reason = format!("it is a folder: expected a file, such as report/index.{ending}");
            return Err(refused(&reason).into());
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        std::fs::create_dir_all(folder).map_err(|error| refused(&error.to_string()))?;
        Ok(())
    }

    /// Checks that the path says nothing else than the contents, or is free where the command chose it.
    fn check(&self) -> Result<(), CliError> {
        let Some(path) = self.path() else {
            return Ok(());
        };
        match self.rule {
            Rule::None => Ok(()),
            Rule::Own if self.contents.is_own(path) => Ok(()),
            Rule::Own => {
                let (name, path) = (self.name, path.display());
                let problem = format!("`{name}` writes {path}, which fastphong did not make");
                let expected = "expected another folder, or `--force` to replace it";
                Err(format!("{problem}: {expected}").into())
            }
            Rule::Ending => {
                let endings = self.contents.endings();
                let is_own = endings.iter().any(|own| has_ending(path, own));
                if is_own || path.extension().is_none() {
                    return Ok(());
                }
                let (name, path, contents) = (self.name, path.display(), self.contents);
                let expected = endings.join(" or .");
                let problem =
                    format!("{path}: `{name}` writes {contents}, which its ending denies");
                Err(format!("{problem}: expected .{expected}").into())
            }
        }
    }

    /// Writes a picture in its format; a file whole or not at all.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write_encoded(&self, picture: &FilePicture) -> Result<(), CliError> {
        let format = self.format().expect("an output of a picture");
        self.write(|out| picture.write_to(format, out))
    }

    /// Writes a text.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write_text(&self, text: &str) -> Result<(), CliError> {
        self.write_bytes(text.as_bytes())
    }

    /// Writes the bytes of a file.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write_bytes(&self, bytes: &[u8]) -> Result<(), CliError> {
        self.write(|out| out.write_all(bytes))
    }

    /// Writes the bytes that `write` writes; a file whole or not at all.
    ///
    /// # Errors
    /// When they cannot or must not be written.
    pub fn write(
        &self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), CliError> {
        self.check()?;
        match &self.path {
            Some(_) => files::write(self.destination(), write),
            None => to_stdout_by(write),
        }
    }
}

/// Returns a folder that the flag `name` gives for files.
///
/// # Errors
/// When it is `-`, which is standard output everywhere.
pub fn folder<'a>(name: &str, path: &'a Path) -> Result<&'a Path, CliError> {
    match path.as_os_str() == "-" {
        false => Ok(path),
        true => {
            let problem = format!("{name}: `-` is standard output, and no folder");
            Err(format!("{problem}: expected a folder").into())
        }
    }
}

/// Makes a folder, if there is none.
///
/// # Errors
/// When that cannot be.
pub fn make_folder(folder: &Path) -> Result<(), CliError> {
    let refused = |error| format!("{}: cannot be made: {error}", folder.display());
    Ok(std::fs::create_dir_all(folder).map_err(refused)?)
}

/// Refuses outputs that are files which are read, or one place.
///
/// # Errors
/// When an output is such a file, under any name.
pub fn check_places(outputs: &[&Output]) -> Result<(), CliError> {
    let mut stdout = outputs.iter().filter(|output| output.is_stdout());
    if let (Some(one), Some(two)) = (stdout.next(), stdout.next()) {
        let problem = format!("`{}` and `{}` name standard output", one.name, two.name);
        return Err(format!("{problem}: expected a file for one of them").into());
    }
    let destinations = outputs.iter().map(|output| output.destination());
    files::check(&destinations.collect::<Vec<_>>())
}

/// Refuses outputs that may not be written: to be called before any work, once all files that are read are known.
///
/// # Errors
/// As [`check_places`]; when the ending of a name denies the contents; when a file is there whose name the command chose, and which
/// fastphong did not make.
pub fn check(outputs: &[&Output]) -> Result<(), CliError> {
    check_places(outputs)?;
    outputs.iter().try_for_each(|output| output.check())
}

/// Lists the files among outputs, a line each.
pub fn written(outputs: &[&Output]) -> String {
    let paths = outputs.iter().filter_map(|output| output.path());
    paths.map(|path| format!("{}\n", path.display())).collect()
}

/// Prints text beside outputs: to standard error if one of them is standard output.
///
/// # Errors
/// As [`to_stdout`].
pub fn print_beside(outputs: &[&Output], text: &str) -> Result<(), CliError> {
    match outputs.iter().any(|output| output.is_stdout()) {
        true => {
            to_stderr(text);
            Ok(())
        }
        false => to_stdout(text),
    }
}

/// Reads `png`, `ppm` or `pfm`.
pub fn format(text: &str) -> Result<Format, String> {
    let mut formats = Format::ALL.into_iter();
    let format = formats.find(|format| format.ending() == text);
    format.ok_or_else(|| "expected png, ppm or pfm".to_owned())
}
