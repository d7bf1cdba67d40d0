package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;

import io.furrow.connect.LogText;
import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.Batches.Rendered;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Writes updates in concurrent batches of different entities. A rejected batch is halved until the rejected entities
 * are isolated, so that one entity does not affect others: 2 log₂ n requests for one of n.
 */
final class EntityWriter implements AutoCloseable {
    /** An update that the context broker rejects, and its reason. */
    record RejectedUpdate(AttributeUpdate attributeUpdate, String words) {}

    /** An update that causes a 500 alone. */
    record FailingUpdate(AttributeUpdate attributeUpdate, Outcome.Unavailable unavailable) {}

    /**
     * The results of updates.
     *
     * @param failing empty unless batches are halved
     * @param failure null if no request failed; else some updates are neither written, rejected nor failing
     */
    record Result(
            List<AttributeUpdate> written, List<RejectedUpdate> refused, List<FailingUpdate> failing, Outcome failure) {
        static Result empty() {
            return new Result(new ArrayList<>(), new ArrayList<>(), new ArrayList<>(), null);
        }

        Result and(Result other) {
            written.addAll(other.written);
            refused.addAll(other.refused);
            failing.addAll(other.failing);
            return new Result(written, refused, failing, failure == null ? other.failure : failure);
        }

        private Result failed(Outcome outcome) {
            return new Result(written, refused, failing, outcome);
        }
    }

    private final BrokerClient client;
    private final ContextBrokerApi api;
    private final Batches batches;
    private final ExecutorService requests;

    /** @param parallel maximum concurrent requests */
    EntityWriter(BrokerClient client, ContextBrokerApi api, Batches batches, int parallel) {
        this.client = client;
        this.api = api;
        this.batches = batches;
        this.requests = parallel == 1 ? null : Executors.newFixedThreadPool(parallel, EntityWriter::daemon);
    }

    private static Thread daemon(Runnable task) {
        Thread thread = new Thread(task, "ngsi-sink-request");
        thread.setDaemon(true);
        return thread;
    }

    /**
     * An interrupt while waiting stays set and counts as {@link Outcome.Unavailable}.
     *
     * @param apart whether a batch that causes a 500 is halved, too
     */
    Result write(List<AttributeUpdate> updates, boolean apart) {
        List<List<Rendered<AttributeUpdate>>> cut = batches.cut(updates.stream()
                .map(attributeUpdate ->
                        new Rendered<>(attributeUpdate, attributeUpdate.key().scope(), api.render(attributeUpdate)))
                .toList());
        Result all = Result.empty();
        if (requests == null || cut.size() == 1) {
            for (int i = 0; i < cut.size() && all.failure() == null; i++) {
                all = all.and(write(cut.get(i), apart, Result.empty()));
            }
            return all;
        }
        return writeTogether(cut, apart);
    }

    /** Waits for all requests, even after one has failed: a request in flight must not overtake a retry. */
    private Result writeTogether(List<List<Rendered<AttributeUpdate>>> cut, boolean apart) {
        List<Future<Result>> underWay = new ArrayList<>();
        for (List<Rendered<AttributeUpdate>> batch : cut) {
            underWay.add(requests.submit(() -> write(batch, apart, Result.empty())));
        }
        Result all = Result.empty();
        boolean interrupted = false;
        for (Future<Result> one : underWay) {
            while (true) {
                try {
                    all = all.and(one.get());
                    break;
                } catch (InterruptedException e) {
                    interrupted = true;
                } catch (ExecutionException e) {
                    throw new IllegalStateException("a request failed for a reason of its own", e.getCause());
                }
            }
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
        return all;
    }

    private Result write(List<Rendered<AttributeUpdate>> batch, boolean apart, Result soFar) {
        Outcome outcome = client.send(api.write(
                batch.get(0).scope(), batch.stream().map(Rendered::json).toList()));
        if (outcome instanceof Outcome.Done done) {
            return taken(batch, done, apart, soFar);
        } else if (outcome instanceof Outcome.Rejected refusal) {
            return refused(batch, refusal.words(), apart, soFar);
        } else if (apart && outcome instanceof Outcome.Unavailable unavailable && FailingChange.isMeant(unavailable)) {
            return failing(batch, unavailable, soFar);
        } else if (outcome instanceof Outcome.Absent absent) {
            return soFar.failed(new Outcome.WrongSetting(api.name() + " is not there: " + absent.words()));
        }
        return soFar.failed(outcome);
    }

    private Result taken(List<Rendered<AttributeUpdate>> batch, Outcome.Done done, boolean apart, Result soFar) {
        try {
            Map<String, String> refused = api.refused(
                    done, batch.stream().map(one -> api.idOf(one.of())).toList());
            for (Rendered<AttributeUpdate> one : batch) {
                String words = refused.get(api.idOf(one.of()));
                if (words == null) {
                    soFar.written().add(one.of());
                } else {
                    soFar.refused().add(new RejectedUpdate(one.of(), words));
                }
            }
            return soFar;
        } catch (UnreadableException e) {
            String words = done.status() + " with a body that cannot be used: " + LogText.beginning(e.getMessage());
            return refused(batch, words, apart, soFar);
        }
    }

    private Result refused(List<Rendered<AttributeUpdate>> batch, String words, boolean apart, Result soFar) {
        if (batch.size() == 1) {
            soFar.refused().add(new RejectedUpdate(batch.get(0).of(), words));
            return soFar;
        }
        return halved(batch, apart, soFar);
    }

    private Result failing(List<Rendered<AttributeUpdate>> batch, Outcome.Unavailable unavailable, Result soFar) {
        if (batch.size() == 1) {
            soFar.failing().add(new FailingUpdate(batch.get(0).of(), unavailable));
            return soFar;
        }
        return halved(batch, true, soFar);
    }

    private Result halved(List<Rendered<AttributeUpdate>> batch, boolean apart, Result soFar) {
        int half = batch.size() / 2;
        Result first = write(batch.subList(0, half), apart, soFar);
        return first.failure() == null ? write(batch.subList(half, batch.size()), apart, first) : first;
    }

    @Override
    public void close() {
        if (requests != null) {
            requests.shutdownNow();
        }
    }
}
