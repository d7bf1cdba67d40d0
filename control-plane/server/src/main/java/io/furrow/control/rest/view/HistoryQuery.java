package io.furrow.control.rest.view;

import java.util.List;

import jakarta.ws.rs.DefaultValue;
import jakarta.ws.rs.QueryParam;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.mission.ThinnedSeries;
import io.furrow.mission.mongo.AttributeHistory;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.event.FiwareScope;

/** The parameters of a request for the history of a device, by default of the last hour. */
public final class HistoryQuery {
    private static final int MAX_ATTRIBUTE_LENGTH = 256;
    private static final int MAX_POINTS = 2_000;
    private static final long HOUR_MS = 3_600_000;

    @QueryParam("attribute")
    private String attribute;

    @QueryParam("from")
    private List<String> froms;

    @QueryParam("to")
    private List<String> tos;

    @QueryParam("mission")
    private String mission;

    @QueryParam("points")
    @DefaultValue("" + MAX_POINTS)
    private int points;

    /** @throws ProblemException if a parameter is missing or invalid */
    public DeviceHistory.Request of(DeviceName device, FiwareScope scope) {
        ProblemException.rejectIf(
                attribute == null, ErrorCode.MISSING_MEMBER, "the request needs the parameter 'attribute'");
        ProblemException.rejectIf(
                attribute.length() > MAX_ATTRIBUTE_LENGTH,
                ErrorCode.WRONG_MEMBER,
                "'attribute' has at most %d characters".formatted(MAX_ATTRIBUTE_LENGTH));
        ProblemException.rejectIf(
                points < ThinnedSeries.MIN_POINTS || points > MAX_POINTS,
                ErrorCode.WRONG_MEMBER,
                "'points' must be a number from %d to %d".formatted(ThinnedSeries.MIN_POINTS, MAX_POINTS));
        long to = ParameterValues.time("to", tos, System.currentTimeMillis());
        long from = ParameterValues.time("from", froms, to - HOUR_MS);
        ProblemException.rejectIf(from >= to, ErrorCode.WRONG_MEMBER, "'from' must be before 'to'");
        return new DeviceHistory.Request(
                scope, device::isOfType, new AttributeHistory.Range(device.id(), attribute, from, to), mission, points);
    }
}
