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
 * Indexes documents by a date, for queries that compare it, unless they name ids. Such queries match no value of another type, so that
 * such values have no entry; but they match an array that contains a date: if the collection has one, the index is not used.
 */
final class DateIndex extends Index<Object> {
    private static final String ID = "_id";

    /** A date in epoch ms, or null for an array, and the key of the document. All entries have the same value. */
    private final MVMap<KeyValue, Object> entries;

    private final String field;

    /** @param key a top-level field of the document */
    DateIndex(String name, IndexKey key, MVMap<KeyValue, Object> entries) {
        super(name, List.of(key), true);
        this.field = key.getKey();
        this.entries = entries;
    }

    /** The keys of all documents that may match a query, in its order; empty if the index does not apply. */
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

    /** A query's range of the date, both ends included. */
    private final class Range {
        private long from = Long.MIN_VALUE;
        private long to = Long.MAX_VALUE;
        private boolean compares;

        /** Ignores conditions on other fields, which only exclude documents. @return whether there is none on the id, which has an index */
        boolean narrow(Document query) {
            for (Map.Entry<String, Object> condition : query.entrySet()) {
                if (condition.getKey().equals(field)) {
                    narrowTo(condition.getValue());
                } else if (condition.getKey().equals(ID)
                        || condition.getKey().equals("$and")
                                && condition.getValue() instanceof Collection<?> all
                                && !all.stream().allMatch(each -> each instanceof Document one && narrow(one))) {
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

        /** Ignores other operators, which only exclude documents. */
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
        return null; // the index of _id has the document's position
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

    /** Always false, because the library would sort the documents. */
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
