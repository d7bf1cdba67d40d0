package io.furrow.ingest.mission;

import java.lang.reflect.InvocationTargetException;
import java.lang.reflect.Proxy;
import java.util.concurrent.atomic.AtomicInteger;

import com.mongodb.MongoCommandException;
import com.mongodb.ServerAddress;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoDatabase;
import org.bson.BsonDocument;

/** A client to a server that refuses to make indexes for a while: another writer is in the way. */
final class RefusingIndexes {
    private static final String NO_SUCH_INDEX =
            "{ok: 0, code: 27, codeName: 'IndexNotFound', errmsg: 'index not found'}";

    private RefusingIndexes() {}

    /** @param refusals how many are left */
    static MongoClient of(MongoClient client, AtomicInteger refusals) {
        return watched(MongoClient.class, client, refusals);
    }

    private static <T> T watched(Class<T> type, T watched, AtomicInteger refusals) {
        return type.cast(Proxy.newProxyInstance(
                type.getClassLoader(), new Class<?>[] {type}, (proxy, method, given) -> {
                    if (method.getName().equals("createIndex")
                            && refusals.getAndUpdate(left -> Math.max(0, left - 1)) > 0) {
                        throw new MongoCommandException(BsonDocument.parse(NO_SUCH_INDEX), new ServerAddress());
                    }
                    try {
                        Object answer = method.invoke(watched, given);
                        return answer instanceof MongoDatabase database
                                ? watched(MongoDatabase.class, database, refusals)
                                : answer instanceof MongoCollection<?> collection
                                        ? watched(MongoCollection.class, collection, refusals)
                                        : answer;
                    } catch (InvocationTargetException e) {
                        throw e.getCause();
                    }
                }));
    }
}
