package io.furrow.connect.source;

import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import io.furrow.connect.repair.LiveEvents;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;

/** Lets the repair know what comes by notification. */
final class WatchedIntake implements Intake {
    /** Is told of each entity on the topic; from any thread. */
    interface Entities {
        void note(FiwareScope scope, String id, boolean gone);
    }

    private final Intake intake;
    private final LiveEvents live;
    private final Entities entities;

    WatchedIntake(Intake intake, LiveEvents live, Entities entities) {
        this.intake = intake;
        this.live = live;
        this.entities = entities;
    }

    @Override
    public Optional<CompletableFuture<Void>> take(List<OutgoingRecord> records) {
        List<OutgoingRecord> events =
                records.stream().filter(WatchedIntake::isEvent).toList();
        List<String> identities = events.stream()
                .map(record -> scope(record.headers()).identity(record.key()))
                .toList();
        return live.handOn(identities, () -> intake.take(records))
                .map(durable -> durable.thenRun(() -> events.forEach(this::durable)));
    }

    private void durable(OutgoingRecord record) {
        live.durable(record.headers().get(HeaderNames.CE_ID));
        entities.note(scope(record.headers()), record.key(), record.value() == null);
    }

    /** A dead letter is none. */
    private static boolean isEvent(OutgoingRecord record) {
        return record.key() != null && record.headers().containsKey(HeaderNames.CE_ID);
    }

    private static FiwareScope scope(Map<String, String> headers) {
        return new FiwareScope(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH));
    }
}
