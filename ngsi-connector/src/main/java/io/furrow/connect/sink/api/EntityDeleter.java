package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Set;

import io.furrow.connect.LogText;
import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.Batches.Rendered;
import io.furrow.connect.sink.api.ContextWriter.RejectedChange;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Deletes entities in batches. If a batch is not deleted completely, one query determines the remaining entities; these
 * are halved until the rejected ones are isolated. An absent entity counts as deleted.
 */
final class EntityDeleter {
    /**
     * The results of deletions; together as many as the deletions.
     *
     * @param deleted those that the context broker confirmed
     * @param absent those that do not exist, perhaps because of this deletion
     * @param failing those that caused a 500 individually
     */
    record Result(
            List<EntityChange> deleted,
            List<EntityChange> absent,
            List<RejectedChange> refused,
            List<FailingChange> failing) {
        static Result empty() {
            return new Result(new ArrayList<>(), new ArrayList<>(), new ArrayList<>(), new ArrayList<>());
        }
    }

    private final BrokerClient client;
    private final ContextBrokerApi api;
    private final EntityTimesLoader sight;
    private final Batches batches;

    EntityDeleter(BrokerClient client, ContextBrokerApi api, EntityTimesLoader sight, Batches batches) {
        this.client = client;
        this.api = api;
        this.sight = sight;
        this.batches = batches;
    }

    /**
     * @param deletions each of another entity
     * @param apart whether a batch that causes a 500 is halved, too
     */
    Result delete(List<EntityChange> deletions, boolean apart)
            throws BrokerUnavailableException, WrongSettingException {
        Result result = Result.empty();
        List<Rendered<EntityChange>> rendered = deletions.stream()
                .map(deletion -> new Rendered<>(deletion, deletion.key().scope(), api.renderDeletion(deletion.key())))
                .toList();
        for (List<Rendered<EntityChange>> batch : batches.cut(rendered)) {
            delete(batch, apart, result);
        }
        return result;
    }

    private void delete(List<Rendered<EntityChange>> batch, boolean apart, Result result)
            throws BrokerUnavailableException, WrongSettingException {
        if (batch.size() == 1) {
            delete(batch.get(0).of(), apart, result);
            return;
        }
        Outcome outcome = client.send(api.delete(
                batch.get(0).scope(), batch.stream().map(Rendered::json).toList()));
        if (outcome instanceof Outcome.Done done && isWhole(done, batch)) {
            batch.forEach(one -> result.deleted().add(one.of()));
        } else if (outcome instanceof Outcome.Unavailable unavailable
                && !(apart && FailingChange.isMeant(unavailable))) {
            throw new BrokerUnavailableException(unavailable);
        } else if (outcome instanceof Outcome.WrongSetting wrong) {
            throw new WrongSettingException(wrong.words());
        } else {
            deleteThoseLeft(batch, apart, result);
        }
    }

    private boolean isWhole(Outcome.Done done, List<Rendered<EntityChange>> batch) {
        try {
            return api.refused(
                            done, batch.stream().map(one -> one.of().key().id()).toList())
                    .isEmpty();
        } catch (UnreadableException e) {
            return false; // what is left will show
        }
    }

    private void deleteThoseLeft(List<Rendered<EntityChange>> batch, boolean apart, Result result)
            throws BrokerUnavailableException, WrongSettingException {
        Set<EntityKey> existing =
                sight.existing(batch.stream().map(one -> one.of().key()).toList());
        List<Rendered<EntityChange>> left = new ArrayList<>();
        for (Rendered<EntityChange> one : batch) {
            if (existing.contains(one.of().key())) {
                left.add(one);
            } else {
                result.absent().add(one.of());
            }
        }
        int half = left.size() == batch.size() ? left.size() / 2 : 0;
        if (half > 0) {
            delete(left.subList(0, half), apart, result);
        }
        if (!left.isEmpty()) {
            delete(left.subList(half, left.size()), apart, result);
        }
    }

    private void delete(EntityChange deletion, boolean apart, Result result)
            throws BrokerUnavailableException, WrongSettingException {
        Outcome outcome = client.send(api.delete(deletion.key()));
        if (outcome instanceof Outcome.Done done) {
            refusal(done, deletion)
                    .ifPresentOrElse(
                            words -> result.refused().add(new RejectedChange(deletion, words)),
                            () -> result.deleted().add(deletion));
        } else if (outcome instanceof Outcome.Absent) {
            result.absent().add(deletion);
        } else if (outcome instanceof Outcome.Rejected refusal) {
            result.refused().add(new RejectedChange(deletion, refusal.words()));
        } else if (outcome instanceof Outcome.WrongSetting wrong) {
            throw new WrongSettingException(wrong.words());
        } else if (outcome instanceof Outcome.Unavailable unavailable) {
            if (!apart || !FailingChange.isMeant(unavailable)) {
                throw new BrokerUnavailableException(unavailable);
            }
            result.failing().add(new FailingChange(deletion, unavailable));
        }
    }
    /** An NGSI-LD broker with several sources answers 207 if one of them did not delete its part. */
    private Optional<String> refusal(Outcome.Done done, EntityChange deletion) {
        String id = deletion.key().id();
        try {
            return Optional.ofNullable(api.refused(done, List.of(id)).get(id));
        } catch (UnreadableException e) {
            return Optional.of(
                    done.status() + " with a body that cannot be used: " + LogText.beginning(e.getMessage()));
        }
    }
}
