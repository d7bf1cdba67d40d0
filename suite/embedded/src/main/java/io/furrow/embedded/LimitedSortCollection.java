package io.furrow.embedded;

import java.util.Comparator;
import java.util.List;
import java.util.PriorityQueue;
import java.util.stream.Stream;

import de.bwaldvogel.mongo.MongoDatabase;
import de.bwaldvogel.mongo.backend.CollectionOptions;
import de.bwaldvogel.mongo.backend.CursorRegistry;
import de.bwaldvogel.mongo.backend.QueryResult;
import de.bwaldvogel.mongo.backend.h2.H2Collection;
import de.bwaldvogel.mongo.bson.Document;
import org.h2.mvstore.MVMap;

/** Sorts a query holding no more documents than it returns, whereas the library holds the whole collection. */
final class LimitedSortCollection extends H2Collection {
    LimitedSortCollection(
            MongoDatabase database,
            String name,
            CollectionOptions options,
            MVMap<Object, Document> documents,
            MVMap<String, Object> meta,
            CursorRegistry cursors) {
        super(database, name, options, documents, meta, cursors);
    }

    @Override
    protected QueryResult queryDocuments(
            Document query, Document order, int skip, int limit, int batchSize, Document fields) {
        return getIndexes().stream()
                .filter(DateIndex.class::isInstance)
                .map(DateIndex.class::cast)
                .flatMap(index -> index.keys(query, order).stream())
                .findFirst()
                .map(keys -> matchDocumentsFromStream(
                        query, keys.map(this::getDocument), skip, limit, batchSize, null, fields))
                .orElseGet(() -> super.queryDocuments(query, order, skip, limit, batchSize, fields));
    }

    private record Numbered(Document document, long number) {}

    @Override
    protected QueryResult matchDocumentsFromStream(
            Document query,
            Stream<Document> documents,
            int skip,
            int limit,
            int batchSize,
            Comparator<Document> order,
            Document fields) {
        if (order == null || limit <= 0) {
            return super.matchDocumentsFromStream(query, documents, skip, limit, batchSize, order, fields);
        }
        List<Document> first =
                first(documents.filter(document -> documentMatchesQuery(document, query)), (long) skip + limit, order);
        return super.matchDocumentsFromStream(query, first.stream(), skip, limit, batchSize, null, fields);
    }

    /** Equivalent to {@code sorted(order).limit(count)}. */
    private static List<Document> first(Stream<Document> documents, long count, Comparator<Document> order) {
        Comparator<Numbered> stable =
                Comparator.comparing(Numbered::document, order).thenComparingLong(Numbered::number);
        PriorityQueue<Numbered> retained = new PriorityQueue<>(stable.reversed());
        long[] number = {0};
        documents.forEachOrdered(document -> {
            retained.add(new Numbered(document, number[0]++));
            if (retained.size() > count) {
                retained.remove();
            }
        });
        return retained.stream().sorted(stable).map(Numbered::document).toList();
    }
}
