/** What the control plane is told and answers, as JSON on the topics of its managers. */
package io.furrow.model.control;
