/**
 * The fields of the farm as of each event's time, for jobs that need to know where a device is.
 *
 * <p>A job's options mix {@link io.furrow.analytics.field.FieldOptions} in ({@code --fields}, {@code --fields-topic}). Its
 * {@code assemble} makes a {@link io.furrow.analytics.field.FieldInput}; a test makes its own. Its page reads
 *
 * <pre>{@code
 * SingleOutputStreamOperator<TopicRecord> fields = in.fields()
 *         .records()
 *         .process(new ParseFields("presence"))
 *         .setParallelism(1) // a version's records stay in order
 *         .uid("recognize-fields")
 *         .name("Recognize fields");
 *
 * fixes.connect(fields.broadcast())
 *         .transform(name, type, new TimelessBroadcastOperator<>(new JoinWithFields(in.fields().atStart()), List.of(FieldVersions.BROADCAST)))
 * }</pre>
 *
 * and its output takes {@code fields.getSideOutput(DeadLetters.TAG)} in. The function that joins is a {@code
 * BroadcastProcessFunction}, or a {@code KeyedBroadcastProcessFunction} if it has state per device, and holds a {@link
 * io.furrow.analytics.field.FieldVersions}: {@code known = FieldVersions.read(atStart)} in {@code open}, {@code known.take(record)}
 * for each broadcast record, {@code known.covering(position, time)} for each event. Fields are not part of Flink's state.
 *
 * <p>The fields that cover a place also change while a device is silent: {@code known.nextChange(time)} says when any
 * field next begins, changes or ends, {@code known.at(id, time)} returns one as of that time. A version that arrives after
 * an event of its time is too late for that event; {@code known.take} says whether a record changed anything.
 */
package io.furrow.analytics.field;
