package io.furrow.mission.archive;

import java.io.FilterInputStream;
import java.io.IOException;
import java.io.InputStream;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** Fails at a line that is longer than a document of MongoDB can be, so that none is read into memory without end. */
final class LineLimit extends FilterInputStream {
    static final int MAX_BYTES = 16 << 20;

    private int length;

    LineLimit(InputStream in) {
        super(in);
    }

    @Override
    public int read() throws IOException {
        byte[] one = new byte[1];
        return read(one, 0, 1) < 0 ? -1 : one[0] & 0xff;
    }

    @Override
    public int read(byte[] bytes, int from, int count) throws IOException {
        int read = super.read(bytes, from, count);
        for (int i = from; i < from + read; i++) {
            length = bytes[i] == '\n' ? 0 : length + 1;
            if (length > MAX_BYTES) {
                String reason = "a line has more than %d MiB".formatted(MAX_BYTES >> 20);
                throw new IOException(reason, new UnreadableException(Reason.TOO_LARGE, reason));
            }
        }
        return read;
    }
}
