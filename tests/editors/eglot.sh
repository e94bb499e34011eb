#!/bin/sh
# Emacs without a screen, with glint lsp started by Eglot as docs/editors.md says: diagnostics, fix, completion, formatting, in both
# spellings. The one that is installed; with a last word `fetched`, that of tools/editors.sh.
. "$(dirname -- "$0")/lib.sh"
editor emacs "${5:-}"
cat >there.el <<'E'
(package-activate-all)
(kill-emacs (if (and (require 'eglot nil t) (require 'yaml-mode nil t)) 0 1))
E
emacs --batch -l package -l there.el >/dev/null 2>&1 || skip "this Emacs has no Eglot, or no yaml-mode ($manual says how)"
recipe Emacs
cat >scene.glint.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5], look_at: [0, 0, 0]}
lights: [{position: [5, 5, 5]}]
spheres:
  - {centre: [0, 0, 0],   radius: 1}
S
cat >scene.glint.xml <<'S'
<Scene glint="1">
  <Camera><Position x="0" y="0" z="5"/><LookAt x="0" y="0" z="0"/></Camera>
  <Light><Position x="5" y="5" z="5"/></Light>
  <Sphere   radus="1"><Center x="0" y="0" z="0"/></Sphere>
</Scene>
S
cat >drive.el <<'E'
(package-activate-all)
(require 'yaml-mode)
(setq make-backup-files nil auto-save-default nil create-lockfiles nil)
(load (expand-file-name "recipe") nil t t)
(defun wait (what test)
  (let ((end (+ (float-time) 60)) value)
    (while (not (setq value (funcall test)))
      (when (> (float-time) end) (error "No %s: %S in %S" what (mapcar #'flymake-diagnostic-text (flymake-diagnostics)) (buffer-string)))
      (accept-process-output nil 0.02)
      (flymake-start))
    value))
(defun drive (file wrong message offered)
  (find-file file)
  (run-hooks 'post-command-hook) ; where `eglot-ensure' waits
  (wait "server" #'eglot-current-server)
  (wait "finding" #'flymake-diagnostics)
  (let ((found (car (flymake-diagnostics))))
    (unless (string-match-p message (flymake-diagnostic-text found)) (error "The finding: %s" (flymake-diagnostic-text found)))
    (goto-char (flymake-diagnostic-beg found))
    (unless (looking-at wrong) (error "The finding is at %S" (buffer-substring (point) (line-end-position)))))
  (eglot-code-actions (point) nil "quickfix" t)
  (when offered
    (search-forward offered)
    (let ((table (nth 2 (eglot-completion-at-point))))
      (unless (member "radius" (mapcar #'substring-no-properties (all-completions "" table))) (error "Completion"))))
  (eglot-format-buffer) ; sends what has changed, which else waits until nobody types
  (wait "silence" (lambda () (null (flymake-diagnostics))))
  (save-buffer))
(drive "scene.glint.yaml" "centre" "has no 'centre'" ",   ")
(drive "scene.glint.xml" "radus" "has no 'radus'" nil)
(mapc #'eglot-shutdown (apply #'append (hash-table-values eglot--servers-by-project)))
E
emacs --batch -l package -l drive.el >log 2>&1 </dev/null || {
    cat log
    fail "emacs"
}
for file in scene.glint.yaml scene.glint.xml; do
    "$glint" check "$file" >report 2>&1 || {
        cat report
        fail "$file has findings"
    }
    "$glint" format --check "$file" >/dev/null 2>&1 || fail "$file is not formatted"
done
echo ok
