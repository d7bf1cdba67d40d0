package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.api.AfterEach;

import io.furrow.connect.sink.FakeContextBroker.Reply;
import io.furrow.model.ngsi.Entity;

/** A task of the sink and its context broker. */
abstract class SinkFixture {
    final FakeContextBroker broker = new FakeContextBroker();
    final FakeSinkContext context = new FakeSinkContext(true);
    final Map<String, String> options =
            new HashMap<>(Map.of("context.broker.url", broker.url().toString()));
    private final List<NgsiSinkTask> started = new ArrayList<>();
    NgsiSinkTask task;

    @AfterEach
    void stop() {
        started.forEach(NgsiSinkTask::stop);
        broker.close();
    }

    /** @param more options, each with its value */
    NgsiSinkTask start(String... more) {
        for (int i = 0; i < more.length; i += 2) {
            options.put(more[i], more[i + 1]);
        }
        task = startWith(context);
        return task;
    }

    NgsiSinkTask startWith(FakeSinkContext of) {
        NgsiSinkTask task = new NgsiSinkTask();
        task.initialize(of);
        task.start(options);
        started.add(task);
        return task;
    }

    void restart(String... more) {
        started.remove(task);
        task.stop();
        start(more);
    }

    /** Lets the context broker refuse what has a text in its path or body. */
    void poison(String what, int status, String words) {
        broker.behaviour =
                update -> (update.path() + update.body()).contains(what) ? new Reply(status, words) : Reply.WRITTEN;
    }

    static byte[] entity(String id, String attribute, long value) {
        return Entity.builder(id, "T").integer(attribute, value).build().toBytes();
    }

    static SinkRecord record(String id, String attribute, long value, long time) {
        return record(id, entity(id, attribute, value), time);
    }

    static SinkRecord deletion(String id, long time) {
        return record(id, null, time);
    }

    /** Its offset is its time. */
    static SinkRecord record(String id, Object value, long time) {
        return new SinkRecord("t", 0, null, id, null, value, time, time, TimestampType.CREATE_TIME);
    }
}
