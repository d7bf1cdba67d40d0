package io.furrow.ingest.mission;

import java.time.Clock;
import java.time.Duration;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;

import com.mongodb.MongoException;
import com.mongodb.client.MongoClient;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

/**
 * Applies the retention to all missions, including those without new events: configures it on a server that removes
 * expired documents itself, and removes them periodically otherwise. Retries later after a failure.
 */
final class ExpiredDocumentsPurger implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ExpiredDocumentsPurger.class);
    private static final long MAX_PAUSE = Duration.ofMinutes(5).toMillis();
    private static final long MIN_PAUSE = Duration.ofSeconds(1).toMillis();
    /** An expired document stays longer by at most this fraction of its retention. */
    private static final int PART = 20;

    private final MongoClient client;
    private final MissionCollections collections;
    private final ScheduledExecutorService thread;

    private ExpiredDocumentsPurger(MongoAccess access, Retention retention) {
        client = access.open();
        collections = new MissionCollections(client, retention, Clock.systemUTC());
        thread = Executors.newSingleThreadScheduledExecutor(work -> {
            Thread made = new Thread(work, "purge of missions");
            made.setDaemon(true);
            return made;
        });
    }

    static ExpiredDocumentsPurger start(MongoAccess access, Retention retention) {
        ExpiredDocumentsPurger purge = new ExpiredDocumentsPurger(access, retention);
        long pause = retention.shortest().map(Duration::toMillis).orElse(MAX_PAUSE) / PART;
        pause = Math.min(MAX_PAUSE, Math.max(MIN_PAUSE, pause));
        purge.thread.scheduleWithFixedDelay(purge::purge, 0, pause, TimeUnit.MILLISECONDS);
        return purge;
    }

    private void purge() {
        try {
            if (collections.serverExpires()) {
                collections.names().forEach(collections::prepared);
            } else {
                long removed = collections.purge();
                LOG.debug("{} expired documents removed", removed);
            }
        } catch (MongoException e) {
            LOG.warn("The retention of missions could not be applied; retrying", e);
        }
    }

    @Override
    public void close() {
        thread.shutdownNow();
        client.close();
    }
}
