package io.furrow.mission.archive;

import java.io.BufferedOutputStream;
import java.io.FilterOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Set;
import java.util.function.LongConsumer;
import java.util.stream.Stream;
import java.util.zip.GZIPInputStream;
import java.util.zip.GZIPOutputStream;

import org.apache.flink.core.fs.FileStatus;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.fs.Path;
import org.apache.flink.core.fs.RecoverableFsDataOutputStream;
import org.apache.flink.util.IOUtils;

/**
 * Reads and writes files of lines on any of Flink's file systems, compressed if the name ends in {@code .gz}. A file
 * appears under its name only when it is complete.
 */
public final class MissionFiles {
    private static final int BUFFER = 64 * 1024;
    private static final Set<String> OBJECT_STORES = Set.of("s3", "s3a", "s3p", "gs", "oss");

    private MissionFiles() {}

    /** Writes the content of a file and returns the number of its lines. */
    public interface Content {
        long writeTo(OutputStream out) throws IOException;
    }

    /** Stores missions. */
    public interface Importer {
        /**
         * Imports lines into a mission, stored events not again.
         *
         * @param source named in messages
         * @return number of lines
         */
        long importFrom(String mission, InputStream in, String source, LongConsumer progress)
                throws IOException, InterruptedException;
    }

    /** Imports a file, or every {@code .ndjson} and {@code .ndjson.gz} of a folder, into a mission. */
    public static long importFrom(Importer missions, String mission, Path path, LongConsumer progress)
            throws IOException, InterruptedException {
        long count = 0;
        for (Path file : filesOf(path)) {
            long before = count;
            try (InputStream in = open(file)) {
                count += missions.importFrom(mission, in, file.toString(), more -> progress.accept(before + more));
            }
        }
        return count;
    }

    static List<Path> filesOf(Path path) throws IOException {
        FileSystem files = path.getFileSystem();
        if (!files.getFileStatus(path).isDir()) {
            return List.of(path);
        }
        return list(path)
                .filter(it -> it.getName().endsWith(".ndjson") || it.getName().endsWith(".ndjson.gz"))
                .toList();
    }

    /** Returns the files of a folder, sorted by name; empty if the folder does not exist. */
    static Stream<Path> list(Path folder) throws IOException {
        FileSystem files = folder.getFileSystem();
        FileStatus[] found = files.exists(folder) ? files.listStatus(folder) : null;
        return found == null
                ? Stream.empty()
                : Arrays.stream(found).map(FileStatus::getPath).sorted(Comparator.comparing(Path::getName));
    }

    static InputStream open(Path file) throws IOException {
        InputStream in = file.getFileSystem().open(file);
        return isCompressed(file) ? new GZIPInputStream(in, BUFFER) : in;
    }

    /** Writes or replaces a file; on file systems without atomic replacement it deletes the old one first. */
    public static long write(Path target, Content content) throws IOException {
        FileSystem files = target.getFileSystem();
        Path file = target.makeQualified(files); // Flink's writer of local files needs a folder
        RecoverableFsDataOutputStream out = files.createRecoverableWriter().open(file);
        boolean complete = false;
        try {
            long count;
            try (OutputStream lines = isCompressed(file)
                    ? new GZIPOutputStream(withoutClose(out), BUFFER)
                    : new BufferedOutputStream(withoutClose(out))) {
                count = content.writeTo(lines);
            }
            RecoverableFsDataOutputStream.Committer finished = out.closeForCommit();
            if (!replaces(files) && files.exists(file)) {
                files.delete(file, false);
            }
            finished.commit();
            complete = true;
            return count;
        } finally {
            if (!complete) {
                IOUtils.closeQuietly(out); // S3 rejects a second close after the commit
                removeUnfinished(file);
            }
        }
    }

    /** Returns whether a commit replaces an existing file: on local file systems and object stores. */
    private static boolean replaces(FileSystem files) {
        return !files.isDistributedFS() || OBJECT_STORES.contains(files.getUri().getScheme());
    }

    private static OutputStream withoutClose(RecoverableFsDataOutputStream out) {
        return new FilterOutputStream(out) {
            @Override
            public void write(byte[] bytes, int from, int length) throws IOException {
                out.write(bytes, from, length);
            }

            @Override
            public void close() {
                // closed by the commit
            }
        };
    }

    /** Deletes the temporary files that Flink's writers keep beside an incomplete file. */
    private static void removeUnfinished(Path file) throws IOException {
        String unfinished = "." + file.getName() + ".inprogress.";
        for (Path one : list(file.getParent())
                .filter(it -> it.getName().startsWith(unfinished))
                .toList()) {
            file.getFileSystem().delete(one, false);
        }
    }

    private static boolean isCompressed(Path file) {
        return file.getName().endsWith(".gz");
    }
}
