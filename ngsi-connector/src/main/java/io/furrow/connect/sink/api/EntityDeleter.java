package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.Batches.Rendered;

/**
 * Deletes entities in batches. If a batch is not deleted completely, one query determines the remaining entities; a
 * single one is then deleted by a separate request. An absent entity counts as deleted.
 */
final class EntityDeleter extends BatchSender<EntityChange> {
    private final BrokerClient client;
    private final EntityTimesLoader loader;

    EntityDeleter(BrokerClient client, ContextBrokerApi api, EntityTimesLoader loader, Batches batches) {
        super(api, batches, 1);
        this.client = client;
        this.loader = loader;
    }

    @Override
    Rendered<EntityChange> render(EntityChange deletion) {
        return new Rendered<>(deletion, deletion.key().scope(), api.renderDeletion(deletion.key(), deletion.type()));
    }

    @Override
    String idOf(EntityChange deletion) {
        return api.idOf(deletion.key(), deletion.type());
    }

    @Override
    Outcome request(List<Rendered<EntityChange>> batch) {
        Rendered<EntityChange> first = batch.get(0);
        return client.send(
                batch.size() == 1
                        ? api.delete(first.of().key(), first.of().type())
                        : api.delete(
                                first.scope(),
                                batch.stream().map(Rendered::json).toList()));
    }

    /** An NGSI-LD broker with several sources answers 207 if one of them did not delete its part of an entity. */
    @Override
    boolean namesRejected(List<Rendered<EntityChange>> batch) {
        return batch.size() == 1;
    }

    @Override
    List<Rendered<EntityChange>> left(List<Rendered<EntityChange>> batch, Result<EntityChange> result)
            throws BrokerUnavailableException, WrongSettingException {
        Map<EntityKey, EntityTimes> existing =
                loader.existing(batch.stream().map(Rendered::of).toList());
        List<Rendered<EntityChange>> left = new ArrayList<>();
        for (Rendered<EntityChange> one : batch) {
            EntityTimes times = existing.get(one.of().key());
            if (times != null && times.mayBeOf(one.of())) {
                left.add(one);
            } else {
                result.absent.add(one.of());
            }
        }
        return left;
    }
}
