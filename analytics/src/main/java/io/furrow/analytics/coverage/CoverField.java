package io.furrow.analytics.coverage;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.MapState;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.PrimitiveArrayTypeInfo;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;

/**
 * Marks the cells that swaths cover and reports the coverage. Key: a coverage, see {@link Swath#key}.
 *
 * <p><b>State</b>: swaths that wait for the watermark; the area of the field, its tiles with covered cells and the figures, see {@link
 * CoverageState}. A tile has 1.5 KiB per 4,096 cells, a field at most {@value FieldGrid#MAX_CELLS} cells.
 *
 * <p><b>Cleared</b>: when the time-to-live has passed since the last swath.
 *
 * <p><b>Late</b>: {@link BuildSwaths} emits nothing that is.
 *
 * <p><b>Emits</b>: a report at each multiple of the interval that follows a swath; it includes all swaths that ended by then.
 */
public final class CoverField extends KeyedProcessFunction<String, Swath, CoverageReport> {
    private static final long serialVersionUID = 1L;

    private final CoverageRules rules;
    private final Reporter reporter;

    private transient SingleTimer timer;
    private transient EventTimeBuffer<Swath> eventTimeBuffer;
    private transient ValueState<CoverageState> coverage;
    private transient ValueState<byte[]> area;
    private transient MapState<Integer, long[]> tiles;
    private transient GridCache grids;

    public CoverField(CoverageRules rules) {
        this.rules = rules;
        this.reporter = new Reporter(rules.every().toMillis());
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer = new EventTimeBuffer<>(getRuntimeContext(), Swath.class, Swath.SEQUENCE, timer);
        coverage = getRuntimeContext().getState(new ValueStateDescriptor<>("coverage", CoverageState.class));
        area = getRuntimeContext()
                .getState(new ValueStateDescriptor<>("area", PrimitiveArrayTypeInfo.BYTE_PRIMITIVE_ARRAY_TYPE_INFO));
        tiles = getRuntimeContext()
                .getMapState(new MapStateDescriptor<>(
                        "tiles", Types.INT, PrimitiveArrayTypeInfo.LONG_PRIMITIVE_ARRAY_TYPE_INFO));
        grids = new GridCache();
    }

    @Override
    public void processElement(Swath swath, Context context, Collector<CoverageReport> out) throws Exception {
        eventTimeBuffer.add(swath, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<CoverageReport> out) throws Exception {
        timer.rang();
        long until = context.timerService().currentWatermark();
        List<Swath> due = eventTimeBuffer.takeDue(context.timerService());
        CoverageState now = coverage.value();
        for (Swath swath : due) {
            now = advance(now, swath.time() - 1, out);
            now = add(now, swath);
        }
        now = advance(now, until, out);
        if (now != null) {
            coverage.update(now);
            timer.ask(Math.min(now.reportAt(), end(now)), context.timerService());
        }
    }

    private long end(CoverageState state) {
        return state.last().time() + rules.timeToLive().toMillis();
    }

    /** Emits the report that is due by an instant, and ends the coverage if its time-to-live has passed by then. */
    private CoverageState advance(CoverageState before, long until, Collector<CoverageReport> out) throws Exception {
        CoverageState now = before;
        if (now != null && now.isReportDue(until)) {
            long time = now.reportAt();
            FieldGrid grid = grid(now);
            CoveredCells cells = cells(grid);
            out.collect(reporter.report(now, time, grid, cells));
            now = now.reported(
                    time,
                    Reporter.RATE_WINDOW,
                    cells.passBefore(time - rules.maxGap().toMillis(), now.recent()));
        }
        if (now != null && end(now) <= until) {
            coverage.clear();
            area.clear();
            tiles.clear();
            return null;
        }
        return now;
    }

    private CoverageState add(CoverageState before, Swath swath) throws Exception {
        CoverageState now = before;
        if (now == null) {
            area.update(swath.area());
            now = CoverageState.begun(swath, rules.cell());
        } else if (swath.from().time() - now.last().time() > Reporter.RATE_WINDOW) {
            now = now.resumedAt(swath.from().time());
        }
        CoveredCells.Added added = cells(grid(now)).add(swath, now.recent());
        long report = Math.min(now.reportAt(), reporter.next(swath.time()));
        return now.with(swath, added.covered(), added.overlapped(), added.recent(), report);
    }

    private FieldGrid grid(CoverageState state) throws Exception {
        return grids.get(area.value(), state.cell());
    }

    private CoveredCells cells(FieldGrid grid) {
        return new CoveredCells(grid, new CoveredCells.Tiles() {
            @Override
            public long[] read(int tile) throws Exception {
                return tiles.get(tile);
            }

            @Override
            public void write(int tile, long[] words) throws Exception {
                tiles.put(tile, words);
            }
        });
    }
}
