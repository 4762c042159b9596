// Nothing: a library that precompiles a header needs a source.
