package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.List;
import java.util.Set;

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
        return new Rendered<>(deletion, deletion.key().scope(), api.renderDeletion(deletion.key()));
    }

    @Override
    String idOf(EntityChange deletion) {
        return deletion.key().id();
    }

    @Override
    Outcome request(List<Rendered<EntityChange>> batch) {
        Rendered<EntityChange> first = batch.get(0);
        return client.send(
                batch.size() == 1
                        ? api.delete(first.of().key())
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
        Set<EntityKey> existing =
                loader.existing(batch.stream().map(one -> one.of().key()).toList());
        List<Rendered<EntityChange>> left = new ArrayList<>();
        for (Rendered<EntityChange> one : batch) {
            if (existing.contains(one.of().key())) {
                left.add(one);
            } else {
                result.absent.add(one.of());
            }
        }
        return left;
    }
}
