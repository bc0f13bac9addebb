//! Every engine on every instruction set of this machine, compared with the scalar span engine, on
//! any count of threads.

mod agreement;
mod coverage;
mod frames;
mod memory;
mod second_passes;
mod streamed;
mod threads;
