package io.furrow.soak.control;

import java.net.URI;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.LongAdder;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.CommandResult;

/** Repeats a request over Kafka or one of the REST APIs until there is an answer. */
final class Requester {
    /** Shorter than an outage, so that requests are also repeated while they are being processed. */
    private static final Duration ANSWER_TIMEOUT = Duration.ofSeconds(5);
    /** Longer than the timeout of the API. */
    private static final Duration CALL_TIMEOUT = Duration.ofSeconds(20);

    private static final Duration BACKOFF = Duration.ofMillis(500);

    private final RequestSender sender;
    private final AnswerLog answers;
    private final List<URI> apis;
    private final Map<String, String> sent = new ConcurrentHashMap<>();
    private final LongAdder repeated = new LongAdder();
    private final LongAdder answered = new LongAdder();

    Requester(RequestSender sender, AnswerLog answers, List<URI> apis) {
        this.sender = sender;
        this.answers = answers;
        this.apis = apis;
    }

    /** Every request by its id, as text. */
    Map<String, String> sent() {
        return sent;
    }

    long repeated() {
        return repeated.sum();
    }

    long answered() {
        return answered.sum();
    }

    /** Blocks until there is an answer, over any number of outages. */
    CommandResult request(ControlRequest request, Random random) throws InterruptedException {
        sent.put(request.id(), request.command() + " " + request.members());
        boolean overKafka = random.nextBoolean();
        for (CommandResult answer = null; ; repeated.increment()) {
            answer = overKafka ? write(request) : call(request, apis.get(random.nextInt(apis.size())));
            if (answer != null) {
                answered.increment();
                return answer;
            }
            Thread.sleep(BACKOFF.toMillis());
        }
    }

    /** Null if there was no answer in time. */
    private CommandResult write(ControlRequest request) {
        sender.write(request);
        return Until.within(ANSWER_TIMEOUT, () -> !answers.to(request.id()).isEmpty())
                ? answers.to(request.id()).get(0)
                : null;
    }

    /** Null if there was no answer, or the request must be retried. */
    private CommandResult call(ControlRequest request, URI api) throws InterruptedException {
        try {
            Http.Answer answer = sender.call(api, request).get(CALL_TIMEOUT.toSeconds(), TimeUnit.SECONDS);
            boolean retry = answer.status() == 0 || answer.status() == 503;
            return retry || !answer.body().isObject() ? null : new CommandResult((ObjectNode) answer.body());
        } catch (TimeoutException | ExecutionException e) {
            return null;
        }
    }
}
