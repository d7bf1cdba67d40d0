package io.furrow.mission.file;

import java.io.FileNotFoundException;
import java.io.IOException;
import java.io.InputStream;
import java.io.Serializable;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

/** The file system of recordings; names in a folder are joined to it with a slash. */
public interface RecordingFiles extends Serializable {
    /** The local file system. */
    RecordingFiles LOCAL = new Local();

    boolean isFolder(String path) throws IOException;

    boolean exists(String path) throws IOException;

    /** Returns the file names of a folder in alphabetical order. */
    List<String> names(String folder) throws IOException;

    /**
     * Reads a file from its beginning.
     *
     * @throws NoSuchFileException or {@link FileNotFoundException} if it was deleted, which ends the recording
     */
    InputStream open(String file) throws IOException;

    /** Reads the local file system with {@code java.nio}. */
    record Local() implements RecordingFiles {
        @Override
        public boolean isFolder(String path) {
            return Files.isDirectory(Path.of(path));
        }

        @Override
        public boolean exists(String path) {
            return Files.exists(Path.of(path));
        }

        @Override
        public List<String> names(String folder) throws IOException {
            try (Stream<Path> found = Files.list(Path.of(folder))) {
                return found.map(path -> path.getFileName().toString()).sorted().toList();
            }
        }

        @Override
        public InputStream open(String file) throws IOException {
            return Files.newInputStream(Path.of(file));
        }
    }
}
