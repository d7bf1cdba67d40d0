package io.furrow.connect.source;

import java.util.List;
import java.util.Map;

import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.connect.connector.Task;
import org.apache.kafka.connect.source.ExactlyOnceSupport;
import org.apache.kafka.connect.source.SourceConnector;

import io.furrow.connect.PluginVersion;

/** Takes the HTTP notifications of a context broker into Kafka, one record per entity. One task: it owns one port. */
public class NgsiSourceConnector extends SourceConnector {
    private Map<String, String> properties;

    /** Made by the worker. */
    public NgsiSourceConnector() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public ConfigDef config() {
        return NgsiSourceConfig.definition();
    }

    @Override
    public Class<? extends Task> taskClass() {
        return NgsiSourceTask.class;
    }

    @Override
    public void start(Map<String, String> properties) {
        new NgsiSourceConfig(properties);
        this.properties = Map.copyOf(properties);
    }

    @Override
    public List<Map<String, String>> taskConfigs(int maxTasks) {
        return List.of(properties);
    }

    /** What waits for its acknowledgement is in memory only, so a crash can repeat or lose what had no answer yet. */
    @Override
    public ExactlyOnceSupport exactlyOnceSupport(Map<String, String> properties) {
        return ExactlyOnceSupport.UNSUPPORTED;
    }

    @Override
    public void stop() {}
}
