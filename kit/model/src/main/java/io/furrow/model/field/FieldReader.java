package io.furrow.model.field;

import java.nio.file.Path;

/** Reads field files, with the libraries for their formats and coordinate systems. */
public interface FieldReader {
    /** For processes without these libraries. */
    FieldReader NONE = (file, options) -> {
        throw new InvalidFileException(
                "no field files are read here; import %s with ./furrow fields import".formatted(file));
    };

    /** @throws InvalidFileException if the file cannot be read at all */
    FieldFile read(Path file, ImportOptions options) throws InvalidFileException;
}
