package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;

import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.Batches.Rendered;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.LogText;

/**
 * Sends updates or deletions of different entities in batches. A batch that is not accepted is halved until the
 * entities at fault are isolated, so that one entity does not affect others: 2 log₂ n requests for one of n.
 */
abstract class BatchSender<T> implements AutoCloseable {
    /** An item that the context broker rejects, and its reason. */
    record Rejected<T>(T of, String words) {}

    /** An entity that alone causes a 500: a defect of the context broker with this entity, or with all. */
    record Failing<T>(T of, Outcome.Unavailable unavailable) {}

    /** The results of updates or deletions; some are missing if a request failed. */
    static final class Result<T> {
        final List<T> accepted = new ArrayList<>();
        /** Items whose entities do not exist, perhaps because of an earlier request. */
        final List<T> absent = new ArrayList<>();

        final List<Rejected<T>> rejected = new ArrayList<>();
        /** Empty unless batches that cause a 500 are halved. */
        final List<Failing<T>> failing = new ArrayList<>();

        private Exception failure;

        private void add(Result<T> other) {
            accepted.addAll(other.accepted);
            absent.addAll(other.absent);
            rejected.addAll(other.rejected);
            failing.addAll(other.failing);
            failure = failure == null ? other.failure : failure;
        }

        void requireComplete() throws BrokerUnavailableException, WrongSettingException {
            if (failure instanceof BrokerUnavailableException unavailable) {
                throw unavailable;
            } else if (failure instanceof WrongSettingException wrong) {
                throw wrong;
            }
        }
    }

    final ContextBrokerApi api;
    private final Batches batches;
    private final ExecutorService requests;

    /** @param parallel maximum concurrent requests */
    BatchSender(ContextBrokerApi api, Batches batches, int parallel) {
        this.api = api;
        this.batches = batches;
        this.requests = parallel == 1 ? null : Executors.newFixedThreadPool(parallel, BatchSender::daemon);
    }

    private static Thread daemon(Runnable task) {
        Thread thread = new Thread(task, "ngsi-sink-request");
        thread.setDaemon(true);
        return thread;
    }

    abstract Rendered<T> render(T one);

    abstract String idOf(T one);

    /** An answer other than {@code Absent} to a batch of updates, any to deletions. */
    abstract Outcome request(List<Rendered<T>> batch);

    /** Whether an answer 2xx names exactly the rejected items. */
    abstract boolean namesRejected(List<Rendered<T>> batch);

    /** The items to send again after a batch was not accepted. */
    abstract List<Rendered<T>> left(List<Rendered<T>> batch, Result<T> result)
            throws BrokerUnavailableException, WrongSettingException;

    /**
     * Sends all and waits for all requests, even after one has failed: a request in flight must not overtake a retry. An
     * interrupt meanwhile stays set and counts as {@link Outcome.Unavailable}.
     *
     * @param isolates whether a batch that causes a 500 is halved, too
     */
    Result<T> send(List<T> all, boolean isolates) {
        Result<T> sum = new Result<>();
        List<List<Rendered<T>>> cut = batches.cut(all.stream().map(this::render).toList());
        if (requests != null && cut.size() > 1) {
            List<CompletableFuture<Result<T>>> underWay = cut.stream()
                    .map(batch -> CompletableFuture.supplyAsync(() -> attempt(batch, isolates), requests))
                    .toList();
            underWay.forEach(one -> sum.add(one.join()));
            return sum;
        }
        for (int i = 0; i < cut.size() && sum.failure == null; i++) {
            sum.add(attempt(cut.get(i), isolates));
        }
        return sum;
    }

    private Result<T> attempt(List<Rendered<T>> batch, boolean isolates) {
        Result<T> result = new Result<>();
        try {
            send(batch, isolates, result);
        } catch (BrokerUnavailableException | WrongSettingException e) {
            result.failure = e;
        }
        return result;
    }

    private void send(List<Rendered<T>> batch, boolean isolates, Result<T> result)
            throws BrokerUnavailableException, WrongSettingException {
        Outcome outcome = request(batch);
        if (outcome instanceof Outcome.Done done) {
            outcome = accepted(done, batch, result);
        }
        if (outcome instanceof Outcome.Done) {
            return;
        }
        if (outcome instanceof Outcome.WrongSetting
                || outcome instanceof Outcome.Unavailable unavailable
                        && !(isolates && Isolation.isMeant(unavailable))) {
            fail(outcome);
        }
        T first = batch.get(0).of();
        if (batch.size() > 1) {
            List<Rendered<T>> left = left(batch, result);
            int half = left.size() == batch.size() ? left.size() / 2 : 0;
            for (List<Rendered<T>> part : List.of(left.subList(0, half), left.subList(half, left.size()))) {
                if (!part.isEmpty()) {
                    send(part, isolates, result);
                }
            }
        } else if (outcome instanceof Outcome.Rejected rejected) {
            result.rejected.add(new Rejected<>(first, rejected.words()));
        } else if (outcome instanceof Outcome.Unavailable unavailable) {
            result.failing.add(new Failing<>(first, unavailable));
        } else {
            result.absent.add(first);
        }
    }

    /** The same outcome if the answer states the result of each item; otherwise the batch counts as rejected. */
    private Outcome accepted(Outcome.Done done, List<Rendered<T>> batch, Result<T> result) {
        Map<String, String> rejected;
        try {
            rejected =
                    api.refused(done, batch.stream().map(one -> idOf(one.of())).toList());
        } catch (UnreadableException e) {
            String words = done.status() + " with a body that cannot be used: " + LogText.beginning(e.getMessage());
            return new Outcome.Rejected(done.status(), words);
        }
        if (!rejected.isEmpty() && !namesRejected(batch)) {
            return new Outcome.Rejected(done.status(), String.join(", ", rejected.values()));
        }
        for (Rendered<T> one : batch) {
            String words = rejected.get(idOf(one.of()));
            if (words == null) {
                result.accepted.add(one.of());
            } else {
                result.rejected.add(new Rejected<>(one.of(), words));
            }
        }
        return done;
    }

    /** @param outcome neither success nor about the content of the request */
    static void fail(Outcome outcome) throws BrokerUnavailableException, WrongSettingException {
        if (outcome instanceof Outcome.Unavailable unavailable) {
            throw new BrokerUnavailableException(unavailable);
        }
        throw new WrongSettingException(
                outcome instanceof Outcome.WrongSetting wrong ? wrong.words() : outcome.toString());
    }

    @Override
    public void close() {
        if (requests != null) {
            requests.shutdownNow();
        }
    }
}
