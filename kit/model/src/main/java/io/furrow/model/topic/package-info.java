/** The names of the topics, see the table in docs/topics.md. */
package io.furrow.model.topic;
