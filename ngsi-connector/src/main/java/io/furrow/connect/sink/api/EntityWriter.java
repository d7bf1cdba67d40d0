package io.furrow.connect.sink.api;

import java.util.List;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.Batches.Rendered;

/** Writes updates in concurrent batches. */
final class EntityWriter extends BatchSender<AttributeUpdate> {
    private static final int NOT_FOUND = 404;

    private final BrokerClient client;

    EntityWriter(BrokerClient client, ContextBrokerApi api, Batches batches, int parallel) {
        super(api, batches, parallel);
        this.client = client;
    }

    @Override
    Rendered<AttributeUpdate> render(AttributeUpdate update) {
        return new Rendered<>(update, update.key().scope(), api.render(update));
    }

    @Override
    String idOf(AttributeUpdate update) {
        return api.idOf(update.key(), update.type());
    }

    @Override
    Outcome request(List<Rendered<AttributeUpdate>> batch) {
        Outcome outcome = client.send(api.write(
                batch.get(0).scope(), batch.stream().map(Rendered::json).toList()));
        return outcome instanceof Outcome.Absent absent
                ? new Outcome.WrongSetting(NOT_FOUND, api.name() + " is not there: " + absent.words())
                : outcome;
    }

    @Override
    boolean namesRejected(List<Rendered<AttributeUpdate>> batch) {
        return true;
    }

    @Override
    List<Rendered<AttributeUpdate>> left(List<Rendered<AttributeUpdate>> batch, Result<AttributeUpdate> result) {
        return batch;
    }
}
