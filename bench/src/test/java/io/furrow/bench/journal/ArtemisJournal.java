package io.furrow.bench.journal;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.concurrent.atomic.AtomicLong;

import org.apache.activemq.artemis.core.io.nio.NIOSequentialFileFactory;
import org.apache.activemq.artemis.core.journal.RecordInfo;
import org.apache.activemq.artemis.core.journal.impl.JournalImpl;

/** The journal of Apache ActiveMQ Artemis over NIO with its buffer, as the broker sets it up: 10 MiB files, 490 kB buffer, 3.3 ms. */
final class ArtemisJournal implements JournalComparison.Candidate {
    private static final int FILE = 10 * 1024 * 1024;
    private static final int BUFFER = 490 * 1024;
    private static final int BUFFER_TIMEOUT_NANOS = 3_333_333;

    private final JournalImpl journal;
    private final AtomicLong ids = new AtomicLong();

    ArtemisJournal(Path folder) throws Exception {
        var files = new NIOSequentialFileFactory(folder.toFile(), true, BUFFER, BUFFER_TIMEOUT_NANOS, 1, false);
        journal = new JournalImpl(FILE, 2, 10, 0, 0, files, "furrow", "journal", 1);
        journal.start();
        journal.load(new ArrayList<RecordInfo>(), new ArrayList<>(), null);
    }

    @Override
    public void append(byte[] record) throws Exception {
        journal.appendAddRecord(ids.incrementAndGet(), (byte) 1, record, true);
    }

    @Override
    public void close() throws IOException {
        try {
            journal.stop();
        } catch (Exception e) { // it declares no narrower type
            throw new IOException(e);
        }
    }
}
