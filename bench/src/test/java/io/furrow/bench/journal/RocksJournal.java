package io.furrow.bench.journal;

import java.nio.ByteBuffer;
import java.nio.file.Path;
import java.util.concurrent.atomic.AtomicLong;

import org.rocksdb.Options;
import org.rocksdb.RocksDB;
import org.rocksdb.RocksDBException;
import org.rocksdb.WriteOptions;

/** RocksDB with a synced write-ahead log; it groups the commits of concurrent writers itself. */
final class RocksJournal implements JournalComparison.Candidate {
    private final Options options = new Options().setCreateIfMissing(true);
    private final WriteOptions synced = new WriteOptions().setSync(true);
    private final RocksDB database;
    private final AtomicLong keys = new AtomicLong();

    RocksJournal(Path folder) throws RocksDBException {
        database = RocksDB.open(options, folder.toString());
    }

    @Override
    public void append(byte[] record) throws RocksDBException {
        byte[] key =
                ByteBuffer.allocate(Long.BYTES).putLong(keys.incrementAndGet()).array();
        database.put(synced, key, record);
    }

    @Override
    public void close() {
        database.close();
        synced.close();
        options.close();
    }
}
