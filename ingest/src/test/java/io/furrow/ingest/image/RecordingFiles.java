package io.furrow.ingest.image;

import java.io.IOException;
import java.util.List;

import org.apache.flink.core.fs.FSDataOutputStream;
import org.apache.flink.core.fs.Path;
import org.apache.flink.core.fs.local.LocalFileSystem;

/** The local file system, with a list of what is asked of it. */
public final class RecordingFiles extends LocalFileSystem {
    private final List<String> calls;

    public RecordingFiles(List<String> calls) {
        this.calls = calls;
    }

    @Override
    public boolean rename(Path from, Path to) throws IOException {
        calls.add("rename");
        return super.rename(from, to);
    }

    @Override
    public FSDataOutputStream create(Path path, WriteMode mode) throws IOException {
        return new Stream(super.create(path, mode));
    }

    private final class Stream extends FSDataOutputStream {
        private final FSDataOutputStream out;

        Stream(FSDataOutputStream out) {
            this.out = out;
        }

        @Override
        public void write(int one) throws IOException {
            out.write(one);
        }

        @Override
        public void write(byte[] bytes, int from, int length) throws IOException {
            calls.add("write");
            out.write(bytes, from, length);
        }

        @Override
        public long getPos() throws IOException {
            return out.getPos();
        }

        @Override
        public void flush() throws IOException {
            out.flush();
        }

        @Override
        public void sync() throws IOException {
            calls.add("sync");
            out.sync();
        }

        @Override
        public void close() throws IOException {
            calls.add("close");
            out.close();
        }
    }
}
