package io.furrow.ingest.mission;

import java.lang.reflect.InvocationTargetException;
import java.lang.reflect.Proxy;
import java.time.Duration;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;

import com.mongodb.MongoCommandException;
import com.mongodb.ServerAddress;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoDatabase;
import org.bson.BsonDocument;

/** A client whose calls of collections are answered before they reach the server. */
final class InterceptedMongo {
    private static final String NO_SUCH_INDEX =
            "{ok: 0, code: 27, codeName: 'IndexNotFound', errmsg: 'index not found'}";

    private InterceptedMongo() {}

    private interface Interceptor {
        /** @return whether this was the answer */
        boolean answers(String method);
    }

    /**
     * To a server that refuses to make indexes for a while: another writer is in the way.
     *
     * @param refusals how many are left
     */
    static MongoClient refusingIndexes(MongoClient client, AtomicInteger refusals) {
        return watched(MongoClient.class, client, method -> {
            if (method.equals("createIndex") && refusals.getAndUpdate(left -> Math.max(0, left - 1)) > 0) {
                throw new MongoCommandException(BsonDocument.parse(NO_SUCH_INDEX), new ServerAddress());
            }
            return false;
        });
    }

    /** To a server that takes everything and answers after a while. */
    static MongoClient answeringAfter(MongoClient client, Duration delay) {
        return watched(MongoClient.class, client, method -> {
            boolean isWrite = method.equals("createIndex") || method.equals("bulkWrite");
            long end = System.nanoTime() + delay.toNanos();
            while (isWrite && System.nanoTime() < end) {
                LockSupport.parkNanos(end - System.nanoTime());
            }
            return isWrite;
        });
    }

    private static <T> T watched(Class<T> type, T watched, Interceptor interceptor) {
        return type.cast(Proxy.newProxyInstance(
                type.getClassLoader(), new Class<?>[] {type}, (proxy, method, given) -> {
                    if (interceptor.answers(method.getName())) {
                        return null;
                    }
                    try {
                        Object answer = method.invoke(watched, given);
                        return answer instanceof MongoDatabase database
                                ? watched(MongoDatabase.class, database, interceptor)
                                : answer instanceof MongoCollection<?> collection
                                        ? watched(MongoCollection.class, collection, interceptor)
                                        : answer;
                    } catch (InvocationTargetException e) {
                        throw e.getCause();
                    }
                }));
    }
}
