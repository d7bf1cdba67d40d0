package io.furrow.analytics.presence;

import java.util.Map;
import java.util.concurrent.TimeUnit;

import org.apache.flink.api.common.functions.RichFilterFunction;
import org.apache.flink.metrics.Gauge;

import io.furrow.flink.TopicRecord;

import static org.awaitility.Awaitility.await;

/**
 * Holds records up until all who follow devices have heard that the fields hold event time up no more: which position is late
 * would else depend on which of their two inputs they read first. They have where the first watermark is their event time.
 */
final class AfterFields extends RichFilterFunction<TopicRecord> {
    private static final long serialVersionUID = 1L;

    private final int followers;
    private transient boolean open;

    AfterFields(int followers) {
        this.followers = followers;
    }

    @Override
    public boolean filter(TopicRecord record) {
        if (record.timestamp() == PresenceJobTest.FIRST) {
            return false;
        }
        if (!open) {
            String job = getRuntimeContext().getJobInfo().getJobId().toString();
            await().atMost(1, TimeUnit.MINUTES).until(() -> unhindered(job) == followers);
            open = true;
        }
        return true;
    }

    private static long unhindered(String job) {
        return PresenceJobTest.METRICS.getMetricsByGroup().entrySet().stream()
                .filter(group -> {
                    Map<String, String> names = group.getKey().getAllVariables();
                    return job.equals(names.get("<job_id>"))
                            && "Follow devices through fields".equals(names.get("<operator_name>"));
                })
                .map(group -> group.getValue().get("currentInputWatermark"))
                .filter(metric -> metric instanceof Gauge<?> gauge && (Long) gauge.getValue() > Long.MIN_VALUE)
                .count();
    }
}
