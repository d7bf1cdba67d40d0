package io.furrow.embedded;

import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.locks.Lock;
import java.util.concurrent.locks.ReadWriteLock;
import java.util.concurrent.locks.ReentrantReadWriteLock;
import java.util.function.Supplier;

import de.bwaldvogel.mongo.MongoCollection;
import de.bwaldvogel.mongo.MongoDatabase;
import de.bwaldvogel.mongo.backend.CollectionOptions;
import de.bwaldvogel.mongo.backend.Index;
import de.bwaldvogel.mongo.backend.IndexKey;
import de.bwaldvogel.mongo.backend.KeyValue;
import de.bwaldvogel.mongo.backend.h2.H2Backend;
import de.bwaldvogel.mongo.backend.h2.H2Database;
import de.bwaldvogel.mongo.bson.Document;
import de.bwaldvogel.mongo.wire.message.MongoMessage;
import io.netty.channel.Channel;
import org.h2.mvstore.MVMap;
import org.h2.mvstore.MVStore;

/**
 * Stores documents in one file, as BSON. It writes before it answers and while no other request is half done, because a document
 * and its index entry are two changes that a sudden end must not separate.
 */
final class MongoFile extends H2Backend {
    /** Cache of recently read or written data, as on the heap. */
    private static final int CACHE_MEGABYTES = 48;

    private static final String INDEX = "._index_";

    private final ReadWriteLock whole = new ReentrantReadWriteLock(true);

    private MongoFile(MVStore store) {
        super(store);
        version(EmbeddedMongo.VERSION);
    }

    static MongoFile open(Path file) {
        return new MongoFile(new MVStore.Builder()
                .fileName(file.toString())
                .cacheSize(CACHE_MEGABYTES)
                .autoCommitDisabled()
                .autoCommitBufferSize(0)
                .open());
    }

    private static MVMap.Builder<KeyValue, Object> indexMap() {
        return new MVMap.Builder<KeyValue, Object>().keyType(new IndexKeyType());
    }

    @Override
    protected MongoDatabase openOrCreateDatabase(String name) {
        return new Database(name);
    }

    /** The library knows the handshake of current drivers and shells only by its former name. */
    @Override
    public Document handleCommand(Channel channel, String database, String command, Document query) {
        return command.equals("hello")
                ? super.handleCommand(channel, database, "isMaster", query).append("isWritablePrimary", true)
                : super.handleCommand(channel, database, command, query);
    }

    @Override
    public Document handleMessage(MongoMessage message) {
        Document answer = locked(whole.readLock(), () -> super.handleMessage(message));
        if (getMvStore().hasUnsavedChanges()) {
            locked(whole.writeLock(), () -> {
                commit();
                return null;
            });
        }
        return answer;
    }

    private static <T> T locked(Lock lock, Supplier<T> action) {
        lock.lock();
        try {
            return action.get();
        } finally {
            lock.unlock();
        }
    }

    /** Opens each map with its own types; the library's index then finds it open. */
    private final class Database extends H2Database {
        Database(String name) {
            super(name, getMvStore(), getCursorRegistry());
        }

        @Override
        protected MongoCollection<Object> openOrCreateCollection(String collection, CollectionOptions options) {
            String name = getFullCollectionNamespace(collection);
            MVMap<Object, Document> documents = getMvStore()
                    .openMap("databases." + name, new MVMap.Builder<Object, Document>().valueType(new DocumentType()));
            MVMap<String, Object> meta = getMvStore().openMap("meta." + name);
            return new LimitedSortCollection(this, collection, options, documents, meta, getCursorRegistry());
        }

        @Override
        protected Index<Object> openOrCreateUniqueIndex(
                String collection, String index, List<IndexKey> keys, boolean sparse) {
            getMvStore().openMap(getFullCollectionNamespace(collection) + INDEX + index, indexMap());
            return super.openOrCreateUniqueIndex(collection, index, keys, sparse);
        }

        /** Uses a date index for a single top-level field. The library leaves its other indexes empty unless unique. */
        @Override
        protected Index<Object> openOrCreateSecondaryIndex(
                String collection, String index, List<IndexKey> keys, boolean sparse) {
            if (keys.size() > 1 || keys.get(0).getKey().contains(".")) {
                return super.openOrCreateSecondaryIndex(collection, index, keys, sparse);
            }
            String name = getFullCollectionNamespace(collection) + INDEX + index;
            return new DateIndex(index, keys.get(0), getMvStore().openMap(name, indexMap()));
        }
    }
}
