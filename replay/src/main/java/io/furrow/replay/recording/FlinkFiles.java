package io.furrow.replay.recording;

import java.io.FileNotFoundException;
import java.io.IOException;
import java.io.InputStream;
import java.util.Arrays;
import java.util.List;

import org.apache.flink.core.fs.FileStatus;
import org.apache.flink.core.fs.Path;

import io.furrow.mission.file.RecordingFiles;

/** Reads recordings from any file system of Flink. */
record FlinkFiles() implements RecordingFiles {
    @Override
    public boolean isFolder(String path) throws IOException {
        Path file = new Path(path);
        return file.getFileSystem().getFileStatus(file).isDir();
    }

    @Override
    public boolean exists(String path) throws IOException {
        Path file = new Path(path);
        return file.getFileSystem().exists(file);
    }

    @Override
    public List<String> names(String folder) throws IOException {
        Path path = new Path(folder);
        FileStatus[] found = path.getFileSystem().listStatus(path);
        if (found == null) {
            throw new FileNotFoundException("There is no folder " + folder);
        }
        return Arrays.stream(found)
                .map(file -> file.getPath().getName())
                .sorted()
                .toList();
    }

    @Override
    public InputStream open(String file) throws IOException {
        Path path = new Path(file);
        return path.getFileSystem().open(path);
    }
}
