package io.furrow.embedded;

import java.time.Instant;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Stream;
import java.util.stream.StreamSupport;

import de.bwaldvogel.mongo.MongoCollection;
import de.bwaldvogel.mongo.backend.Index;
import de.bwaldvogel.mongo.backend.IndexKey;
import de.bwaldvogel.mongo.backend.KeyValue;
import de.bwaldvogel.mongo.bson.Document;
import org.h2.mvstore.Cursor;
import org.h2.mvstore.MVMap;

/**
 * Documents in the order of a date, for queries that ask for this date alone. Those that compare it find no value of another type, so
 * that other values have no entry; but they find an array that holds a date: with one in the collection the index answers nothing.
 */
final class DateIndex extends Index<Object> {
    private static final String ID = "_id";

    /** A date in epoch ms, or null for an array, and the key of the document. Every entry has the same value. */
    private final MVMap<KeyValue, Object> entries;

    private final String field;

    /** @param key a field of the document itself */
    DateIndex(String name, IndexKey key, MVMap<KeyValue, Object> entries) {
        super(name, List.of(key), true);
        this.field = key.getKey();
        this.entries = entries;
    }

    /** The keys of all documents that a query may find, in its order; empty where the index does not know them. */
    Optional<Stream<Object>> keys(Document query, Document order) {
        Range range = new Range();
        if (!isByDate(order) || !range.narrow(query) || !range.compares || hasArrays()) {
            return Optional.empty();
        }
        boolean backwards = order != null && order.get(field) instanceof Number direction && direction.intValue() < 0;
        KeyValue first = new KeyValue(range.from, null);
        KeyValue last = range.to == Long.MAX_VALUE ? null : new KeyValue(range.to + 1, null);
        Cursor<KeyValue, Object> found =
                backwards ? entries.cursor(last, first, true) : entries.cursor(first, last, false);
        Iterable<KeyValue> each = () -> found;
        return Optional.of(StreamSupport.stream(each.spliterator(), false).map(key -> key.get(1)));
    }

    private boolean isByDate(Document order) {
        return order == null || order.isEmpty() || order.size() == 1 && order.containsKey(field);
    }

    private boolean hasArrays() {
        KeyValue first = entries.firstKey();
        return first != null && first.get(0) == null;
    }

    /** What a query demands of the date, both ends included. */
    private final class Range {
        private long from = Long.MIN_VALUE;
        private long to = Long.MAX_VALUE;
        private boolean compares;

        /** @return whether it demands nothing else */
        boolean narrow(Document query) {
            for (Map.Entry<String, Object> condition : query.entrySet()) {
                if (condition.getKey().equals(field)) {
                    narrowTo(condition.getValue());
                } else if (!condition.getKey().equals("$and")
                        || !(condition.getValue() instanceof Collection<?> all)
                        || !all.stream().allMatch(each -> each instanceof Document one && narrow(one))) {
                    return false;
                }
            }
            return true;
        }

        private void narrowTo(Object value) {
            if (value instanceof Document comparisons) {
                comparisons.forEach(this::narrowTo);
            } else {
                narrowTo("$eq", value);
            }
        }

        /** Others only take away. */
        private void narrowTo(String operator, Object value) {
            if (!(value instanceof Instant date)) {
                return;
            }
            boolean isEqual = operator.equals("$eq");
            if (isEqual || operator.equals("$gt") || operator.equals("$gte")) {
                from = Math.max(from, date.toEpochMilli());
                compares = true;
            }
            if (isEqual || operator.equals("$lt") || operator.equals("$lte")) {
                to = Math.min(to, date.toEpochMilli());
                compares = true;
            }
        }
    }

    @Override
    public void add(Document document, Object key, MongoCollection<Object> collection) {
        Object value = document.get(field);
        if (value instanceof Instant date) {
            entries.put(new KeyValue(date.toEpochMilli(), key), true);
        } else if (value instanceof Collection) {
            entries.put(new KeyValue(null, key), true);
        }
    }

    @Override
    public Object remove(Document document) {
        Long date = document.get(field) instanceof Instant instant ? instant.toEpochMilli() : null;
        entries.remove(new KeyValue(date, document.get(ID)));
        return null; // that of _id tells where the document is
    }

    @Override
    public void updateInPlace(Document before, Document after, Object key, MongoCollection<Object> collection) {
        remove(before);
        add(after, key, collection);
    }

    @Override
    public void checkAdd(Document document, MongoCollection<Object> collection) {}

    @Override
    public void checkUpdate(Document before, Document after, MongoCollection<Object> collection) {}

    @Override
    public Object getPosition(Document document) {
        return null;
    }

    /** Never by the library, which would sort what it finds. */
    @Override
    public boolean canHandle(Document query) {
        return false;
    }

    @Override
    public Iterable<Object> getPositions(Document query) {
        return List.of();
    }

    @Override
    public long getCount() {
        return entries.sizeAsLong();
    }

    @Override
    public long getDataSize() {
        return getCount();
    }

    @Override
    public void drop() {}
}
