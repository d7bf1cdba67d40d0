package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.state.heap.HeapKeyedStateBackend;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;

/** {@link CoverField} alone, with time as data; can be stopped and continue, as from a savepoint. */
final class Covering {
    private final CoverageRules rules;
    private KeyedProcessOperator<String, Swath, CoverageReport> operator;
    private KeyedOneInputStreamOperatorTestHarness<String, Swath, CoverageReport> harness;

    Covering(CoverageRules rules) throws Exception {
        this.rules = rules;
        begin();
        harness.open();
    }

    private void begin() throws Exception {
        operator = new KeyedProcessOperator<>(new CoverField(rules));
        harness = new KeyedOneInputStreamOperatorTestHarness<>(operator, Swath::key, Types.STRING);
    }

    void restart() throws Exception {
        var state = harness.snapshot(1, 1);
        harness.close();
        begin();
        harness.initializeState(state);
        harness.open();
    }

    void receive(Swath swath) throws Exception {
        harness.processElement(new StreamRecord<>(swath, swath.time()));
    }

    List<CoverageReport> advance(long watermark) throws Exception {
        harness.processWatermark(new Watermark(watermark));
        List<CoverageReport> reports = new ArrayList<>(harness.extractOutputValues());
        harness.getOutput().clear();
        return reports;
    }

    int entries() {
        return ((HeapKeyedStateBackend<?>) operator.getKeyedStateBackend()).numKeyValueStateEntries();
    }

    int timers() {
        return harness.numEventTimeTimers();
    }

    void stop() throws Exception {
        harness.close();
    }
}
