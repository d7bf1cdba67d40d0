package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.function.Function;
import java.util.function.LongSupplier;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.RepairSettings.Deletions;
import io.furrow.connect.repair.RepairSettings.Reading;
import io.furrow.connect.subscription.DesiredSubscription;
import io.furrow.connect.subscription.IdPartition;
import io.furrow.connect.subscription.NotificationContent;
import io.furrow.connect.subscription.Subject;
import io.furrow.connect.subscription.Target;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/** A source with its caretaker and without the rest: its journal is a topic in memory, which outlives it. */
final class ModelSource implements RepairOutput, AutoCloseable {
    static final FiwareScope PLACE = new FiwareScope("agri", "/");

    private static final EventTimeRule TIMES = EventTimeRule.within(Duration.ofMinutes(5));
    private static final DesiredSubscription WANTED = new DesiredSubscription(
            new DesiredSubscription.Name("furrow farm", IdPartition.ALL, new FiwareScope("agri", "/#")),
            Subject.ANY,
            new NotificationContent(List.of("*", "dateModified"), "normalized", false),
            new Target("http://127.0.0.1:1/v2/notify", Map.of(), Optional.empty()),
            DesiredSubscription.Throttling.EVERY_CHANGE);

    /**
     * What is on the topic.
     *
     * @param values of the last record, by id and type
     * @param gone by id and type, whether its last record has no value
     * @param unreadable ids and times of dead letters
     */
    record Topic(Map<String, String> values, Map<String, Boolean> gone, Map<String, Instant> unreadable) {
        Topic() {
            this(new HashMap<>(), new HashMap<>(), new HashMap<>());
        }

        private void changed(Entity entity) {
            String key = entity.id() + " " + entity.type();
            values.put(key, entity.value("t").orElseThrow().asText());
            gone.put(key, false);
        }

        private void deleted(String type, String id) {
            values.remove(id + " " + type);
            gone.put(id + " " + type, true);
        }
    }

    private final Topic topic;
    private final Ledger ledger = new Ledger();
    private final RecordTracker live;
    private final SubscriptionReconciler reconciler;
    private MissedChange[] last = new MissedChange[0];

    ModelSource(Function<BrokerRequest, Outcome> broker, LongSupplier nanos, Path folder, Bounds bounds, Topic topic)
            throws IOException {
        this.topic = topic;
        live = new RecordTracker(bounds.recent());
        RepairSettings settings = new RepairSettings(
                folder,
                Duration.ofSeconds(2),
                RepairSettings.Mode.INITIAL,
                new Reading(bounds.page(), bounds.pageBytes(), TIMES, List.of()),
                new Deletions(1 << 20, bounds.deletions()));
        reconciler = new SubscriptionReconciler(
                broker, WANTED, settings, new SubscriptionReconciler.SharedServices(live, this, ledger, nanos));
        live.onStale(this::markStale);
        live.onOverflow(this::noteLate);
    }

    /** Bounds of pages, in entities and bytes, of what is remembered, in bytes, and least time between listings. */
    record Bounds(int page, long pageBytes, long recent, Duration deletions) {}

    void look() throws BrokerException, IOException, InterruptedException {
        reconciler.poll();
    }

    void markStale(String identity) {
        try {
            reconciler.markStale(identity);
        } catch (IOException e) {
            throw new AssertionError(e);
        }
    }

    private void noteLate(Instant from) {
        try {
            reconciler.noteLate(from);
        } catch (IOException e) {
            throw new AssertionError(e);
        }
    }

    String unconfirmed() {
        return reconciler.unconfirmed();
    }

    Ledger ledger() {
        return ledger;
    }

    /** There is no room for it. */
    void turnAway(ModelBroker.Told told) {
        live.arrived(told.subscription());
        ledger.rejectedUnavailable.increment();
    }

    void take(ModelBroker.Told told) {
        try {
            Entity entity = Entity.of(told.entity().json(told.gone()));
            Instant now = Instant.now();
            String eventId = told.gone()
                    ? EntityDeletion.of(entity, PLACE, now, TIMES.maxSkew(), Origin.NOTIFICATION)
                            .id()
                    : EntityEvent.of(entity, PLACE, now, TIMES, Origin.NOTIFICATION)
                            .id();
            EntityVersion version = EntityVersion.of(entity);
            String identity = PLACE.identity(entity.type(), entity.id());
            live.arrived(told.subscription());
            live.append(
                    told.subscription(),
                    List.of(new TrackedRecord(identity, eventId, version.modified(), told.gone())),
                    () -> {
                        if (told.gone()) {
                            topic.deleted(entity.type(), entity.id());
                        } else {
                            topic.changed(entity);
                        }
                        return Optional.of(CompletableFuture.completedFuture(null));
                    });
            reconciler.note(identity, told.gone());
        } catch (UnreadableException | IOException e) {
            throw new AssertionError(e);
        }
    }

    @Override
    public byte[] serialize(String subscription, MissedChange finding) {
        last = java.util.Arrays.copyOf(last, last.length + 1);
        last[last.length - 1] = finding;
        return java.nio.ByteBuffer.allocate(4).putInt(last.length - 1).array();
    }

    @Override
    public Optional<CompletableFuture<Void>> append(List<byte[]> records) {
        for (byte[] record : records) {
            MissedChange finding = last[java.nio.ByteBuffer.wrap(record).getInt()];
            if (finding instanceof MissedChange.Changed changed) {
                topic.changed(changed.event().entity());
            } else if (finding instanceof MissedChange.Deleted deleted) {
                topic.deleted(deleted.deletion().type(), deleted.deletion().entityId());
            } else if (finding instanceof MissedChange.Unreadable unreadable) {
                topic.unreadable()
                        .put(
                                unreadable.entityId() + " "
                                        + unreadable.state().entity().type(),
                                unreadable.state().time());
            }
        }
        return Optional.of(CompletableFuture.completedFuture(null));
    }

    @Override
    public void close() throws IOException {
        reconciler.close();
    }
}
