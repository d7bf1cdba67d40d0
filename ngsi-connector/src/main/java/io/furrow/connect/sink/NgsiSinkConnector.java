package io.furrow.connect.sink;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

import org.apache.kafka.common.config.Config;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.connect.connector.Task;
import org.apache.kafka.connect.sink.SinkConnector;

import io.furrow.connect.CrossFieldValidator;
import io.furrow.connect.PluginVersion;

/** Writes the entities of topics to a context broker. Tasks share the partitions. */
public class NgsiSinkConnector extends SinkConnector {
    private Map<String, String> properties;

    /** Called by the worker. */
    public NgsiSinkConnector() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public ConfigDef config() {
        return NgsiSinkConfig.definition();
    }

    @Override
    public Config validate(Map<String, String> options) {
        return CrossFieldValidator.with(super.validate(options), () -> new NgsiSinkConfig(options));
    }

    @Override
    public Class<? extends Task> taskClass() {
        return NgsiSinkTask.class;
    }

    @Override
    public void start(Map<String, String> properties) {
        new NgsiSinkConfig(properties);
        this.properties = Map.copyOf(properties);
    }

    @Override
    public List<Map<String, String>> taskConfigs(int maxTasks) {
        return IntStream.range(0, maxTasks).mapToObj(this::task).toList();
    }

    private Map<String, String> task(int index) {
        Map<String, String> task = new HashMap<>(properties);
        task.put(NgsiSinkConfig.TASK_INDEX, Integer.toString(index));
        return task;
    }

    @Override
    public void stop() {}
}
