//! Pictures on their way into a file.

use std::borrow::Cow;
use std::io::{self, Write};
use std::vec::Vec;

use super::netpbm::{PpmWriter, check_size, write_pfm};
use super::{EncodeError, encode_png};
use crate::picture::{LinearPicture, Picture8};

/// A picture that fits a format. Except for PNG its bytes are made while they are written, so that they are never in
/// memory all at once.
#[derive(Clone, Debug)]
pub struct Encoder<'a>(Form<'a>);

#[derive(Clone, Debug)]
enum Form<'a> {
    Png(Vec<u8>),
    Ppm(Cow<'a, Picture8>),
    Pfm(Cow<'a, LinearPicture>),
}

impl<'a> Encoder<'a> {
    pub(super) fn png(picture: &Picture8) -> Result<Self, EncodeError> {
        encode_png(picture).map(|bytes| Encoder(Form::Png(bytes)))
    }

    pub(super) fn ppm(picture: Cow<'a, Picture8>) -> Result<Self, EncodeError> {
        check_size(picture.width(), picture.height()).map(|()| Encoder(Form::Ppm(picture)))
    }

    pub(super) fn pfm(picture: Cow<'a, LinearPicture>) -> Result<Self, EncodeError> {
        check_size(picture.width(), picture.height()).map(|()| Encoder(Form::Pfm(picture)))
    }

    /// Writes the bytes of the file to `out`, which needs no buffer.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        match &self.0 {
            Form::Png(bytes) => out.write_all(bytes),
            Form::Ppm(picture) => {
                let mut file = PpmWriter::new(out, picture.width(), picture.height())
                    .map_err(io::Error::other)?;
                file.texels(picture.texels())?;
                file.finish()
            }
            Form::Pfm(picture) => write_pfm(picture, out),
        }
    }

    /// The bytes of the file.
    pub fn bytes(self) -> Vec<u8> {
        if let Form::Png(bytes) = self.0 {
            return bytes;
        }
        let mut bytes = Vec::new();
        self.write_to(&mut bytes)
            .expect("memory takes all that is written");
        bytes
    }
}
