package io.furrow.analytics.temperature;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;

import org.apache.flink.api.common.ExecutionConfig;
import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.streaming.api.windowing.assigners.WindowAssigner;
import org.apache.flink.streaming.api.windowing.triggers.EventTimeTrigger;
import org.apache.flink.streaming.api.windowing.triggers.Trigger;
import org.apache.flink.streaming.api.windowing.windows.TimeWindow;

import io.furrow.flink.record.Epochs;

/**
 * Assigns event-time windows that begin at whole multiples of the slide since 1970 of the original time, in each epoch of a replay:
 * the span of an epoch is not a whole number of most windows. In epoch 0 they and their state equal those of Flink's own assigners.
 */
final class EpochWindows extends WindowAssigner<Object, TimeWindow> {
    private static final long serialVersionUID = 1L;

    private final long size;
    private final long slide;

    private EpochWindows(long size, long slide) {
        this.size = size;
        this.slide = slide;
    }

    /** @param slide from start to start; the size if windows do not overlap */
    static EpochWindows of(Duration size, Duration slide) {
        return new EpochWindows(size.toMillis(), slide.toMillis());
    }

    @Override
    public Collection<TimeWindow> assignWindows(Object element, long time, WindowAssignerContext context) {
        long begin = Epochs.begin(time);
        List<TimeWindow> windows = new ArrayList<>((int) (size / slide));
        long last = begin + TimeWindow.getWindowStartWithOffset(Epochs.original(time), 0, slide);
        for (long start = last; start > time - size; start -= slide) {
            windows.add(new TimeWindow(start, start + size));
        }
        return windows;
    }

    @Override
    public Trigger<Object, TimeWindow> getDefaultTrigger() {
        return EventTimeTrigger.create();
    }

    @Override
    public TypeSerializer<TimeWindow> getWindowSerializer(ExecutionConfig config) {
        return new TimeWindow.Serializer();
    }

    @Override
    public boolean isEventTime() {
        return true;
    }
}
