package io.furrow.ingest.latest;

import java.time.Duration;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import org.apache.flink.api.common.TaskInfo;
import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.state.KeyGroupRangeAssignment;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.runtime.state.VoidNamespaceSerializer;
import org.apache.flink.streaming.api.SimpleTimerService;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Merges as {@link MergeLatest}; a job without state begins with the content of {@code data.latest}, so that a partial entity
 * never replaces the whole, and no older value a newer one.
 *
 * <p>State: that of {@link MergeLatest}, and a flag that the topic was read. Each subtask reads the whole topic and stores
 * the entities of its own keys.
 */
public final class MergeLatestOperator extends KeyedProcessOperator<String, ReportedEvent, TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(MergeLatestOperator.class);

    private final MergeLatest merge;
    private final LatestKey key;
    private final TopicSnapshot latest;
    private final Duration maxAhead;
    private transient ListState<Boolean> mark;
    private transient boolean wasRead;

    /** @param maxAhead how far plausible records may be ahead of the clock */
    public MergeLatestOperator(MergeLatest merge, LatestKey key, TopicSnapshot latest, Duration maxAhead) {
        super(merge);
        this.merge = merge;
        this.key = key;
        this.latest = latest;
        this.maxAhead = maxAhead;
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        mark = context.getOperatorStateStore()
                .getUnionListState(new ListStateDescriptor<>("latest-read", Types.BOOLEAN));
        wasRead = mark.get().iterator().hasNext();
    }

    @Override
    public void open() throws Exception {
        super.open();
        if (!wasRead) {
            begin();
        }
    }

    /** Applies several records of an entity in order; skips entities that have state already. */
    private void begin() throws Exception {
        TimerService timers =
                new SimpleTimerService(getInternalTimerService("user-timers", VoidNamespaceSerializer.INSTANCE, this));
        long newest = System.currentTimeMillis() + maxAhead.toMillis();
        Set<String> begun = new HashSet<>();
        latest.forEach(record -> {
            String identity = record.key() == null ? null : key.identityOf(record);
            if (identity == null || !isMine(identity)) {
                return;
            }
            setCurrentKey(identity);
            if (begun.contains(identity) || !merge.knows()) {
                try {
                    merge.begin(record, newest, timers);
                    begun.add(identity);
                } catch (UnreadableException e) {
                    LOG.warn("{} is not an entity and is skipped: {}", record.position(), e.getMessage());
                }
            }
        });
        LOG.info("Started with {} entities of the topic data.latest", begun.size());
    }

    private boolean isMine(String identity) {
        TaskInfo task = getRuntimeContext().getTaskInfo();
        return KeyGroupRangeAssignment.assignKeyToParallelOperator(
                        identity, task.getMaxNumberOfParallelSubtasks(), task.getNumberOfParallelSubtasks())
                == task.getIndexOfThisSubtask();
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        mark.update(List.of(true));
    }
}
